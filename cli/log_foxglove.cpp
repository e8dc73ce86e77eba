// SPDX-License-Identifier: MIT
#include "log_foxglove.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/file.hpp"
#include "base/text.hpp"
#include "console.hpp"
#include "run/pictures/record.hpp"

namespace hallway::cli {
namespace {

/// The pictures of a run folder, by name.
std::vector<run::Attachment> pictures_of(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().extension() == ".png") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  std::vector<run::Attachment> pictures;
  for (const fs::path& file : files) pictures.push_back({file.filename().string(), read_file(file)});
  return pictures;
}

}  // namespace

std::optional<fs::path> recorded_log(const std::string& log) {
  std::error_code code;
  const fs::path path = mcap_file(log);
  if (path.extension() != ".mcap") return std::nullopt;
  if (fs::is_directory(log, code) && !fs::exists(path, code)) return std::nullopt;
  return path;
}

std::uint32_t write_with_foxglove(const LogChoice& choice, const fs::path& log, log::ByteOutput& output,
                                  std::vector<std::string>& warnings) {
  check_no_csv_options(choice);
  const log::FileInput input(log);
  const bool in_run_folder = log.filename() == run::files::kLog && run::is_run_folder(log.parent_path());
  const run::FoxgloveCopy copy = in_file(log, [&] {
    return run::copy_with_foxglove(
        input, output, in_run_folder ? pictures_of(log.parent_path()) : std::vector<run::Attachment>{});
  });
  if (copy.damage) {
    print_warning(warnings,
                  fmt::format("{}: byte {}: {}; kept what stands before: {} frames", printable(log.string()),
                              copy.damage->offset, copy.damage->cause, copy.frames));
  }
  return copy.frames;
}

}  // namespace hallway::cli
