// SPDX-License-Identifier: MIT
#include "slam_plane/core/gap.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::slam_plane {
namespace {

constexpr double kGapSpeed = 1.5;    // times the fastest motion so far, that a robot may move unseen
constexpr double kGapStep_m = 0.01;  // and what is added each frame

}  // namespace

bool OpenGaps::watch(const Frame& frame, const Pose2& motion, double fastest) {
  const bool tied = frame.in_map.determined();
  const bool any = frame.in_map.heading;
  // What is mapped after a blind time is tied by the prediction alone, also where some walls were in view before it.
  const bool opens = !tied && (was_tied_ || (!any && !gaps_.back().is_blind));
  was_tied_ = tied;
  if (tied) return false;
  if (opens) {
    ++epoch_;
    // Where no wall is known, the way ahead is what is known least.
    if (!any) parts_.push_back({epoch_, part()});
    gaps_.push_back({epoch_, any ? frame.in_map.direction : frame.T_map_robot.r,
                     any ? 0.0 : kBridgeFrames * fastest, !any});
  }
  Gap& gap = gaps_.back();
  // How far it can have gone; standing about, a robot does not go far.
  const double travel = std::abs(frame.T_map_robot.rotate(motion.t).dot(gap.direction));
  const double most = kGapSpeed * fastest * std::abs(frame.T_map_robot.r.dot(gap.direction));
  gap.range_m += std::max(travel, most) + kGapStep_m;
  return opens;
}

int OpenGaps::close(const Frame& frame, const std::function<PoseInformation(std::uint32_t, Pose2&)>& fit) {
  int closed = 0;
  while (!gaps_.empty() && was_tied_) {
    Pose2 T = frame.T_map_robot;
    if (!fit(gaps_.back().epoch, T).determined()) break;
    if ((T.t - frame.T_map_robot.t).norm() > Gap::kBridged_m) break;
    gaps_.pop_back();
    ++closed;
  }
  return closed;
}

void OpenGaps::erase(const Gap& gap) {
  std::erase_if(gaps_, [&](const Gap& other) { return other.epoch == gap.epoch; });
  was_tied_ = true;  // a frame that is not tied opens a new one
}

bool OpenGaps::is_open(std::uint32_t epoch) const {
  return std::ranges::any_of(gaps_, [&](const Gap& gap) { return gap.epoch == epoch; });
}

std::uint32_t OpenGaps::part() const {
  for (auto gap = gaps_.rbegin(); gap != gaps_.rend(); ++gap) {
    if (gap->is_blind) return gap->epoch;
  }
  return 0;
}

std::vector<JoinedPart> OpenGaps::joined_parts() const {
  std::vector<JoinedPart> joined;
  for (const JoinedPart& begun : parts_) {
    if (is_open(begun.part)) continue;
    // What it came after is older, and resolved.
    std::uint32_t into = begun.into;
    for (const JoinedPart& older : joined) {
      if (older.part == into) into = older.into;
    }
    joined.push_back({begun.part, into});
  }
  return joined;
}

std::uint32_t OpenGaps::epochs_known() const {
  for (auto gap = gaps_.rbegin(); gap != gaps_.rend(); ++gap) {
    if (gap->is_wide()) return gap->epoch;
  }
  return 0;
}

}  // namespace hallway::slam_plane
