// SPDX-License-Identifier: MIT
#include "import/kind.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "base/error.hpp"
#include "base/text.hpp"
#include "import/cloud_folder.hpp"
#include "import/point_table.hpp"
#include "import/words.hpp"
#include "log/byte_io.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;

/// In the order of Kind.
constexpr std::array kKindNames{"clouds", "tum",   "victoria-park", "stereo-tracks", "range-bearing",
                                "bag",    "kitti", "euroc",         "pcd-imu"};

std::optional<Kind> kind_of_file(const fs::path& path) {
  constexpr std::uint64_t kFirstBytes = 1024;
  std::string begin;
  const log::FileInput file(path);
  file.read(0, std::min(kFirstBytes, file.size()), begin);
  if (begin.starts_with("#ROSBAG")) return Kind::kBag;
  if (begin.starts_with("ply\n") || begin.starts_with("ply\r") || begin.starts_with("# .PCD")) {
    return Kind::kClouds;
  }
  if (path.extension() == ".bag") return Kind::kBag;
  const std::string_view line = std::string_view(begin).substr(0, begin.find('\n'));
  if (const auto columns = point_columns_of(line)) {
    return *columns == PointColumns::kCamera ? Kind::kStereoTracks : Kind::kRangeBearing;
  }
  return is_cloud_file(path) ? std::optional(Kind::kClouds) : std::nullopt;
}

std::optional<Kind> kind_of_folder(const fs::path& folder) {
  const auto holds = [&](const char* name) {
    std::error_code code;
    return fs::exists(folder / name, code);
  };
  if (holds("run.json") || holds("run.mcap")) return std::nullopt;
  if (holds("depth.txt") || holds("associations.txt")) return Kind::kTum;
  if (holds("observations.csv")) {
    return holds("scans.csv") ? std::optional(Kind::kVictoriaPark) : std::nullopt;
  }
  if (holds("mav0") || holds("imu0")) return Kind::kEuroc;
  if (holds("sequences") || (holds("velodyne") && holds("times.txt"))) return Kind::kKitti;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    if (!is_cloud_file(entry->path())) continue;
    const bool pcd = lower_case(entry->path().extension().string()) == ".pcd";
    return pcd && holds("imu.csv") ? Kind::kPcdImu : Kind::kClouds;
  }
  throw Error(code ? ErrorCode::kIo : ErrorCode::kBadInput,
              code ? "cannot read the folder: " + code.message()
                   : "holds no log (run.mcap, observations.csv) and no known recording (.ply or .pcd files, "
                     "depth.txt, associations.txt, scans.csv, mav0, sequences, velodyne)",
              {.file = printable(folder.string(), 4096)});
}

}  // namespace

const char* kind_name(Kind kind) {
  return kKindNames[static_cast<std::size_t>(kind)];
}

std::optional<Kind> kind_named(std::string_view name) {
  const auto found = std::find(kKindNames.begin(), kKindNames.end(), name);
  if (found == kKindNames.end()) return std::nullopt;
  return static_cast<Kind>(found - kKindNames.begin());
}

std::optional<Kind> tell_kind(const fs::path& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (status.type() == fs::file_type::directory) return kind_of_folder(path);
  if (status.type() == fs::file_type::regular) return kind_of_file(path);
  return std::nullopt;
}

}  // namespace hallway::import
