// SPDX-License-Identifier: MIT
// The text files of the KITTI odometry layout.
#include <fmt/format.h>

#include <cmath>

#include "base/text.hpp"
#include "import/kitti_odometry.hpp"
#include "import/word_lines.hpp"
#include "import/words.hpp"

namespace hallway::import {
namespace {

/// Twelve numbers from word `first` on, with none after them.
PoseRows twelve_numbers(const WordLines& lines, std::size_t first) {
  const auto& words = lines.words();
  PoseRows rows{};
  if (words.size() != first + rows.size()) {
    throw lines.error(
        fmt::format("{} numbers where the rows of a 3x4 matrix have {}", words.size() - first, rows.size()));
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto number = parse_double(words[first + i]);
    if (!number || std::abs(*number) > kMaxImport_m) {
      throw lines.error(fmt::format("a finite number within {:g} is needed, \"{}\" found", kMaxImport_m,
                                    printable(words[first + i], 40)));
    }
    rows[i] = *number;
  }
  return rows;
}

Pose pose_in(const WordLines& lines, std::size_t first_word) {
  const PoseRows rows = twelve_numbers(lines, first_word);
  if (const std::string fault = fault_of(rows); !fault.empty()) throw lines.error(fault);
  return pose_of(rows);
}

void check_frames(const WordLines& lines, std::size_t frames) {
  if (frames >= kMaxKittiFrames)
    throw lines.error(
        fmt::format("more than {} lines, which is most for names of six digits", kMaxKittiFrames));
}

}  // namespace

KittiCalibration parse_kitti_calibration(std::string_view text, const std::string& file) {
  WordLines lines(text, file);
  KittiCalibration calibration;
  bool has_tr = false;
  while (lines.next()) {
    const std::string_view name = lines.words().front();
    if (name == "Tr:") {
      if (has_tr) throw lines.error("Tr is there twice");
      calibration.T_cam0_velodyne = pose_in(lines, 1);
      has_tr = true;
    } else if (name.size() == 3 && name[0] == 'P' && name[1] >= '0' && name[1] <= '3' && name[2] == ':') {
      auto& projection = calibration.projection[static_cast<std::size_t>(name[1] - '0')];
      if (projection) throw lines.error(fmt::format("P{} is there twice", name[1]));
      projection = twelve_numbers(lines, 1);
    } else if (!name.ends_with(':')) {
      throw lines.error(
          fmt::format("a name with a colon is needed, \"{}\" found", printable(lines.words().front(), 40)));
    }
  }
  if (!has_tr)
    throw Error(ErrorCode::kBadInput, "has no line Tr:, the transform from the lidar to camera 0",
                {.file = file});
  return calibration;
}

std::vector<std::int64_t> parse_kitti_times(std::string_view text, const std::string& file) {
  WordLines lines(text, file);
  std::vector<std::int64_t> times;
  while (lines.next()) {
    check_frames(lines, times.size());
    const auto t_ns = lines.words().size() == 1 ? parse_seconds(lines.words().front()) : std::nullopt;
    if (!t_ns) {
      throw lines.error(
          fmt::format("a time in seconds below 9e9 is needed, \"{}\" found", printable(lines.line(), 40)));
    }
    if (!times.empty() && *t_ns <= times.back()) {
      throw lines.error(fmt::format("the time {} is not after the one above it", lines.line()));
    }
    times.push_back(*t_ns);
  }
  if (times.empty()) throw Error(ErrorCode::kBadInput, "has no times", {.file = file});
  return times;
}

std::vector<Pose> parse_kitti_poses(std::string_view text, const std::string& file) {
  WordLines lines(text, file);
  std::vector<Pose> poses;
  while (lines.next()) {
    check_frames(lines, poses.size());
    poses.push_back(pose_in(lines, 0));
  }
  if (poses.empty()) throw Error(ErrorCode::kBadInput, "has no poses", {.file = file});
  return poses;
}

}  // namespace hallway::import
