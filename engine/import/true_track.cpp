// SPDX-License-Identifier: MIT
#include "import/true_track.hpp"

#include <algorithm>
#include <utility>

namespace hallway::import {
namespace {

Pose between(const TimedPose& a, const TimedPose& b, std::int64_t t_ns) {
  const double share = static_cast<double>(t_ns - a.t_ns) / static_cast<double>(b.t_ns - a.t_ns);
  return {a.T_world_body.q.slerp(share, b.T_world_body.q),
          a.T_world_body.t + share * (b.T_world_body.t - a.T_world_body.t)};
}

}  // namespace

TrueTrack::TrueTrack(std::vector<TimedPose> poses, std::int64_t within_ns)
    : poses_(std::move(poses)), within_ns_(within_ns) {}

std::optional<Pose> TrueTrack::at(std::int64_t t_ns) const {
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), t_ns,
                                      [](const TimedPose& pose, std::int64_t t) { return pose.t_ns < t; });
  const bool after_near = after != poses_.end() && after->t_ns - t_ns <= within_ns_;
  if (after != poses_.end() && after->t_ns == t_ns) return after->T_world_body;
  const bool before_near = after != poses_.begin() && t_ns - std::prev(after)->t_ns <= within_ns_;
  if (before_near && after_near) return between(*std::prev(after), *after, t_ns);
  if (before_near) return std::prev(after)->T_world_body;
  if (after_near) return after->T_world_body;
  return std::nullopt;
}

}  // namespace hallway::import
