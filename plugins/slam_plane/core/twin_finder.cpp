// SPDX-License-Identifier: MIT
#include "slam_plane/core/twin_finder.hpp"

#include <algorithm>
#include <cmath>

#include "slam_plane/core/shift_search.hpp"

namespace hallway::slam_plane {
namespace {

constexpr double kTwinSine = 0.02;            // of the largest angle between walls that are one
constexpr double kPartDistance_m = 0.9;       // between two walls that may be parts of one
constexpr double kPartOffset_m = 0.05;        // of the one from the line of the other
constexpr std::uint32_t kPartSightings = 20;  // of each of them
constexpr std::uint32_t kPartHidden =
    3;  // of the ends that face each other, with something in front of the rest
constexpr std::uint64_t kPartFrames = 30;  // since they were seen: their ends had their chance

}  // namespace

Index TwinFinder::twin_of(const WallMap& map, Index w, std::uint32_t known, std::uint64_t iteration) const {
  if (map.walls[w].merged_into != kNone || map.walls[w].is_dynamic || map.walls[w].count < least_count_)
    return kNone;
  const WallEstimate& wall = map.walls[w].estimate;
  Index twin = kNone;
  const auto look_at = [&](Index other) {
    if (other == w || map.walls[other].is_dynamic || map.walls[other].count < least_count_ || other > twin)
      return;
    if ((map.walls[other].epoch < known) != (map.walls[w].epoch < known)) return;
    bool contradict = false;
    if (are_twins(map.walls[other].estimate, wall, Vec2::Zero(), bound_m_, kTwinSine, contradict) ||
        are_parts(map.walls[other], map.walls[w], iteration))
      twin = other;
  };
  for (const double share : {0.0, 0.5, 1.0}) {
    map.visit_near(wall.basis.point(wall.reach[kEndA] + share * (wall.reach[kEndB] - wall.reach[kEndA])),
                   look_at);
  }
  return twin;
}

/// Two walls out of view, on one line with a short overlap, or a short distance between which something hides.
bool TwinFinder::are_parts(const WallRecord& one, const WallRecord& other, std::uint64_t iteration) const {
  if (std::min(one.count, other.count) < kPartSightings) return false;
  if (std::max(one.last_seen, other.last_seen) + kPartFrames > iteration) return false;
  const WallBasis& basis = one.estimate.basis;
  const Vec2& direction = other.estimate.basis.direction;
  if (basis.direction.dot(direction) <= 0.0 || std::abs(cross(basis.direction, direction)) > kTwinSine)
    return false;
  const Vec2 end[2] = {other.estimate.basis.point(other.estimate.reach[kEndA]),
                       other.estimate.basis.point(other.estimate.reach[kEndB])};
  const double shorter = std::min(one.estimate.reach[kEndB] - one.estimate.reach[kEndA],
                                  other.estimate.reach[kEndB] - other.estimate.reach[kEndA]);
  for (int k = 0; k < 2; ++k) {  // the end of `one` that faces the other
    const double sign = k == kEndA ? -1.0 : 1.0;
    const double apart = sign * (basis.along(end[1 - k]) - one.estimate.reach[k]);
    if (apart < -0.5 * shorter || apart > kPartDistance_m) continue;  // more overlap makes twins
    return !one.estimate.known[k] && !other.estimate.known[1 - k] &&
           (apart <= 0.0 || std::min(one.hidden[k], other.hidden[1 - k]) >= kPartHidden) &&
           std::abs(basis.across(end[1 - k])) < kPartOffset_m;
  }
  return false;
}

}  // namespace hallway::slam_plane
