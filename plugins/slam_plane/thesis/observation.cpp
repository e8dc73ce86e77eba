// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/observation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hallway::slam_plane::thesis {
namespace {

bool in_bounds(const Vec2& p) {
  return std::abs(p.x()) <= kMaxCoordinate_m && std::abs(p.y()) <= kMaxCoordinate_m;  // false for NaN
}

}  // namespace

Segment operator*(const Pose2& T_to_from, const Segment& segment) {
  return {{T_to_from * segment.end[kEndA], T_to_from * segment.end[kEndB]}};
}

std::optional<TimedObservation> make_observation(const WallObservation& seen, Iteration iteration) {
  if (!in_bounds(seen.a) || !in_bounds(seen.b)) return std::nullopt;
  TimedObservation observation;
  observation.iteration = iteration;
  observation.segment = {{seen.a, seen.b}};
  if (cross(seen.a, seen.b) > 0.0) std::swap(observation.segment.end[kEndA], observation.segment.end[kEndB]);
  observation.length = observation.segment.length();
  if (!(observation.length > 1e-9)) return std::nullopt;
  observation.direction = observation.segment.direction();
  observation.z_low = seen.z_low;
  observation.z_high = seen.z_high;
  return observation;
}

FrameObservations::FrameObservations(std::span<const WallObservation> seen, Iteration iteration) {
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const std::optional<TimedObservation> observation = make_observation(seen[i], iteration);
    if (!observation) continue;
    list.push_back(*observation);
    given.push_back(i);
  }
}

}  // namespace hallway::slam_plane::thesis
