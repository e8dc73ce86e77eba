// SPDX-License-Identifier: MIT
#include "import/pcd_imu_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "import/new_folder.hpp"
#include "import/point_records.hpp"
#include "import/timed_poses.hpp"
#include "import/words.hpp"
#include "log/row_file.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;

constexpr ImuColumns kFolderImuColumns{"t_ns", "wx", "wy", "wz", "ax", "ay", "az"};
constexpr const char* kFolderImuHeader = "t_ns,wx,wy,wz,ax,ay,az";

std::string name_for_errors(const fs::path& path) {
  return printable(path.string(), 4096);
}

[[noreturn]] void refuse_folder(const fs::path& path, const std::string& cause) {
  throw Error(ErrorCode::kBadInput, cause, {.file = name_for_errors(path)});
}

TimedCloud timed_cloud(const fs::path& file) {
  const auto t_ns = time_of_name(file.stem().string());
  if (t_ns) return {*t_ns, file};
  refuse_folder(file,
                "is not named by a time: NANOSECONDS.pcd, or SECONDS.NANOSECONDS.pcd with nine decimals");
}

std::vector<TimedCloud> find_clouds(const fs::path& folder) {
  std::vector<TimedCloud> clouds;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    if (lower_case(entry->path().extension().string()) != ".pcd") continue;
    if (clouds.size() == kMaxFolderClouds)
      refuse_folder(folder, fmt::format("has more than {} clouds", kMaxFolderClouds));
    clouds.push_back(timed_cloud(entry->path()));
  }
  if (code)
    throw Error(ErrorCode::kIo, "cannot read the folder: " + code.message(),
                {.file = name_for_errors(folder)});
  if (clouds.empty()) refuse_folder(folder, "has no clouds (files that end in .pcd)");
  std::ranges::sort(clouds, [](const TimedCloud& a, const TimedCloud& b) {
    return std::tie(a.t_ns, a.file) < std::tie(b.t_ns, b.file);
  });
  const auto same = std::ranges::adjacent_find(clouds, {}, &TimedCloud::t_ns);
  if (same != clouds.end())
    refuse_folder(std::next(same)->file, "has the time of " + printable(same->file.filename().string()));
  return clouds;
}

bool exists_at(const fs::path& path) {
  std::error_code code;
  return fs::exists(fs::symlink_status(path, code));
}

}  // namespace

LidarCloud PcdImuFolder::cloud(std::size_t index) const {
  const fs::path& file = clouds[index].file;
  return parse_lidar_pcd(read_file(file, kMaxCloudBytes), name_for_errors(file));
}

PcdImuFolder open_pcd_imu_folder(const fs::path& folder) {
  const fs::path imu = folder / "imu.csv", truth = folder / "truth.tum", mounts = folder / "mounts.toml";
  PcdImuFolder opened;
  opened.clouds = find_clouds(folder);
  opened.imu = parse_folder_imu(read_file(imu), name_for_errors(imu));
  if (exists_at(truth)) opened.truth = parse_timed_poses(read_file(truth), name_for_errors(truth));
  if (exists_at(mounts)) opened.mounts = parse_mounts(read_file(mounts, 1u << 20), name_for_errors(mounts));
  return opened;
}

std::optional<std::int64_t> time_of_name(std::string_view stem) {
  constexpr std::size_t kDecimals = 9;
  const auto only_digits = [](std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
  };
  const std::size_t point = stem.find('.');
  if (point == std::string_view::npos) return only_digits(stem) ? parse_int(stem) : std::nullopt;
  const std::string_view whole = stem.substr(0, point), decimals = stem.substr(point + 1);
  if (!only_digits(whole) || !only_digits(decimals) || decimals.size() != kDecimals) return std::nullopt;
  return parse_int(std::string(whole) + std::string(decimals));
}

std::vector<ImuSample> parse_folder_imu(std::string_view text, const std::string& file) {
  return parse_imu_table(text, file, kFolderImuColumns);
}

/// The tables under way.
struct PcdImuFolderWriter::Files {
  fs::path folder;
  log::RowFile imu;
  std::unique_ptr<log::RowFile> truth{};  ///< made with the first pose
  std::int64_t cloud_last_ns = -1, imu_last_ns = -1, truth_last_ns = -1;

  static void check_later(std::int64_t t_ns, std::int64_t last_ns, const fs::path& file) {
    if (t_ns <= last_ns) refuse_folder(file, fmt::format("the time {} ns is not after {} ns", t_ns, last_ns));
  }
};

PcdImuFolderWriter::PcdImuFolderWriter(const fs::path& folder, const std::optional<RigMounts>& mounts) {
  const fs::path file = folder / "mounts.toml";
  if (mounts && !(is_sound(mounts->T_body_lidar) && is_sound(mounts->T_body_imu)))
    refuse_folder(file, "a mount is not finite, or no rotation");
  make_new_folder(folder);
  if (mounts) write_file_atomically(file, print_mounts(*mounts));
  files_.reset(new Files{.folder = folder, .imu = log::RowFile(folder / "imu.csv", ',', kFolderImuHeader)});
}

PcdImuFolderWriter::~PcdImuFolderWriter() = default;

void PcdImuFolderWriter::add(std::int64_t t_ns, const LidarCloud& cloud) {
  const fs::path file = files_->folder / fmt::format("{}.pcd", t_ns);
  Files::check_later(t_ns, files_->cloud_last_ns, file);
  write_file_atomically(file, print_lidar_pcd(cloud, name_for_errors(file)));
  files_->cloud_last_ns = t_ns;
}

void PcdImuFolderWriter::add(const ImuSample& sample) {
  check_sample(sample, files_->imu_last_ns, name_for_errors(files_->folder / "imu.csv"));
  add_row(files_->imu.next_row(), sample);
  files_->imu_last_ns = sample.t_ns;
}

void PcdImuFolderWriter::add(const TimedPose& T_world_body) {
  const fs::path file = files_->folder / "truth.tum";
  Files::check_later(T_world_body.t_ns, files_->truth_last_ns, file);
  if (T_world_body.t_ns >= kTimesEnd_ns)
    refuse_folder(file, fmt::format("the time {} ns is not below 9e9 s", T_world_body.t_ns));
  if (!is_sound(T_world_body.T_world_body))
    refuse_folder(file, fmt::format("the pose at {} ns is not finite, or no rotation", T_world_body.t_ns));
  if (!files_->truth) files_->truth = std::make_unique<log::RowFile>(file, ' ', "# t x y z qx qy qz qw");
  add_row(files_->truth->next_row(), T_world_body);
  files_->truth_last_ns = T_world_body.t_ns;
}

void PcdImuFolderWriter::close() {
  if (files_->cloud_last_ns < 0) refuse_folder(files_->folder, "there are no clouds to write");
  if (files_->imu_last_ns < 0) refuse_folder(files_->folder / "imu.csv", "there are no samples to write");
  files_->imu.close();
  if (files_->truth) files_->truth->close();
}

}  // namespace hallway::import
