// SPDX-License-Identifier: MIT
#include "import/cloud_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "import/frame_list.hpp"
#include "import/pcd.hpp"
#include "import/ply.hpp"
#include "import/point_records.hpp"
#include "import/words.hpp"
#include "log/observations.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kDefaultPeriod_ns = 100'000'000;
constexpr const char* kTimes = "timestamps.txt";

/// A number of any length, so that two compare as numbers: digits before the point by their count and value, then those behind it.
using NameNumber = std::tuple<std::size_t, std::string, std::string>;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Where the run of digits that ends at `end` begins.
std::size_t digits_begin(const std::string& text, std::size_t end) {
  while (end > 0 && is_digit(text[end - 1])) --end;
  return end;
}

std::optional<NameNumber> number_in(const std::string& stem) {
  std::size_t end = stem.size();
  while (end > 0 && !is_digit(stem[end - 1])) --end;
  if (end == 0) return std::nullopt;
  std::size_t begin = digits_begin(stem, end);
  std::string whole = stem.substr(begin, end - begin), fraction;
  if (begin >= 2 && stem[begin - 1] == '.' && is_digit(stem[begin - 2])) {
    fraction = whole;
    fraction.erase(fraction.find_last_not_of('0') + 1);
    const std::size_t point = begin - 1;
    begin = digits_begin(stem, point);
    whole = stem.substr(begin, point - begin);
  }
  whole.erase(0, whole.find_first_not_of('0'));
  return NameNumber{whole.size(), whole, fraction};
}

struct NumberedFile {
  NameNumber number;
  fs::path path;
};

[[noreturn]] void refuse(const fs::path& path, const std::string& cause) {
  throw Error(ErrorCode::kBadInput, cause, {.file = printable(path.string())});
}

std::vector<NumberedFile> numbered_files(const fs::path& folder) {
  std::vector<NumberedFile> files;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    if (!is_cloud_file(entry->path())) continue;
    const auto number = number_in(entry->path().stem().string());
    if (!number)
      refuse(entry->path(),
             fmt::format("has no number in its name to order it by, and there is no {}", kTimes));
    files.push_back({*number, entry->path()});
    if (files.size() > log::kMaxIteration) refuse(folder, "has more files than a log may have frames");
  }
  if (code)
    throw Error(ErrorCode::kIo, "cannot read the folder: " + code.message(),
                {.file = printable(folder.string())});
  if (files.empty()) refuse(folder, "has no files that end in .ply or .pcd");
  std::sort(files.begin(), files.end(), [](const NumberedFile& a, const NumberedFile& b) {
    return std::tie(a.number, a.path) < std::tie(b.number, b.path);
  });
  for (std::size_t i = 1; i < files.size(); ++i) {
    if (files[i].number != files[i - 1].number) continue;
    refuse(files[i].path,
           "has the same number in its name as " + printable(files[i - 1].path.filename().string()));
  }
  return files;
}

std::vector<FrameFile> find_frames(const fs::path& path, const CloudOptions& options) {
  std::error_code code;
  if (!fs::is_directory(path, code)) return {{0, path}};
  if (!options.times.empty()) return read_frame_list(options.times, path);
  if (fs::exists(path / kTimes, code)) return read_frame_list(path / kTimes, path);
  std::vector<NumberedFile> files = numbered_files(path);
  const std::int64_t period_ns = options.period_ns.value_or(kDefaultPeriod_ns);
  if (period_ns > std::numeric_limits<std::int64_t>::max() / static_cast<std::int64_t>(files.size())) {
    throw Error(ErrorCode::kUsage,
                fmt::format("--period: {} frames would end beyond all times", files.size()));
  }
  std::vector<FrameFile> frames;
  for (NumberedFile& file : files) {
    frames.push_back({period_ns * static_cast<std::int64_t>(frames.size()), std::move(file.path)});
  }
  return frames;
}

bool has_extension(const fs::path& path, std::string_view wanted) {
  return lower_case(path.extension().string()) == wanted;
}

class CloudFolder : public Recording {
 public:
  CloudFolder(std::vector<FrameFile> frames, const CloudOptions& options)
      : frames_(std::move(frames)), options_(options) {}

  std::uint32_t frames() const override { return static_cast<std::uint32_t>(frames_.size()); }
  void read(std::uint32_t index, Frame& frame) override {
    const FrameFile& file = frames_[index];
    frame.t_ns = file.t_ns;
    frame.T_world_body.reset();
    PointCollector points(frame, options_.stride);
    const std::string content = read_file(file.path, kMaxCloudBytes);
    const std::string name = printable(file.path.string(), 4096);
    try {
      if (content.empty()) throw Error(ErrorCode::kBadInput, "is empty");
      if (content.starts_with("ply") || has_extension(file.path, ".ply")) {
        read_ply(content, name, points);
      } else {
        read_pcd(content, name, points);
      }
    } catch (const Error& error) {
      if (!error.where().file.empty()) throw;
      throw Error(error.code(), error.message(), {.file = name});
    }
  }
  std::int64_t period_ns() const override {
    return mean_period_ns(frames_.front().t_ns, frames_.back().t_ns, frames_.size(),
                          options_.period_ns.value_or(kDefaultPeriod_ns));
  }
  std::string sensor() const override { return "clouds"; }
  bool has_truth() const override { return false; }

 private:
  std::vector<FrameFile> frames_;
  CloudOptions options_;
};

}  // namespace

std::unique_ptr<Recording> open_clouds(const fs::path& path, const CloudOptions& options) {
  return std::make_unique<CloudFolder>(find_frames(path, options), options);
}

bool is_cloud_file(const fs::path& path) {
  return has_extension(path, ".ply") || has_extension(path, ".pcd");
}

}  // namespace hallway::import
