// SPDX-License-Identifier: MIT
#include "import/timed_poses.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "base/text.hpp"
#include "base/unit_quaternion.hpp"
#include "geom/arrays.hpp"
#include "import/lidar_cloud.hpp"
#include "import/word_lines.hpp"
#include "import/words.hpp"

namespace hallway::import {
namespace {

TimedPose timed_pose_of(const WordLines& lines) {
  constexpr std::size_t kWords = 8;
  const auto& words = lines.words();
  if (words.size() != kWords) {
    throw lines.error(fmt::format("{} numbers where t x y z qx qy qz qw need {}", words.size(), kWords));
  }
  const auto t_ns = parse_seconds(words[0]);
  if (!t_ns) {
    throw lines.error(
        fmt::format("a time in seconds below 9e9 is needed, \"{}\" found", printable(words[0], 40)));
  }
  std::array<double, kWords> v{};
  for (std::size_t i = 1; i < kWords; ++i) {
    const auto number = parse_double(words[i]);
    if (!number || std::abs(*number) > kMaxImport_m) {
      throw lines.error(fmt::format("a finite number within {:g} is needed, \"{}\" found", kMaxImport_m,
                                    printable(words[i], 40)));
    }
    v[i] = *number;
  }
  const std::array wxyz{v[7], v[4], v[5], v[6]};
  if (!is_unit_quaternion(wxyz, kUnitFileTolerance))
    throw lines.error("the quaternion qx qy qz qw does not have unit length");
  Pose pose = to_pose(std::array{v[1], v[2], v[3]}, wxyz);
  pose.q.normalize();
  return {*t_ns, pose};
}

}  // namespace

std::string format_seconds(std::int64_t t_ns) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  return fmt::format("{}.{:09}", t_ns / kSecond_ns, t_ns % kSecond_ns);
}

std::vector<TimedPose> parse_timed_poses(std::string_view text, const std::string& file) {
  WordLines lines(text, file);
  std::vector<TimedPose> poses;
  while (lines.next()) {
    if (lines.line().starts_with('#')) continue;
    const TimedPose pose = timed_pose_of(lines);
    if (!poses.empty() && pose.t_ns <= poses.back().t_ns) {
      throw lines.error(fmt::format("the time {} is not after the one above it", lines.words()[0]));
    }
    poses.push_back(pose);
  }
  if (poses.empty()) throw Error(ErrorCode::kBadInput, "has no poses", {.file = file});
  return poses;
}

void add_row(log::RowWriter& out, const TimedPose& pose) {
  const Quat& q = pose.T_world_body.q;
  out.word(format_seconds(pose.t_ns)).numbers(to_array(pose.T_world_body.t));
  out.number(q.x()).number(q.y()).number(q.z()).number(q.w()).end_row();
}

bool is_sound(const Pose& pose) {
  return pose.t.cwiseAbs().maxCoeff() <= kMaxImport_m && is_pose(to_array(pose.t), to_array(pose.q));
}

}  // namespace hallway::import
