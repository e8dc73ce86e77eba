// SPDX-License-Identifier: MIT
#include "slam_plane/core/duplicate_finder.hpp"

#include <algorithm>
#include <cmath>

#include "slam_plane/core/shift_search.hpp"

namespace hallway::slam_plane {
namespace {

constexpr double kDuplicateSine = 0.02;          // of the largest angle between walls that are one
constexpr double kPartDistance_m = 0.9;          // between two walls that may be parts of one
constexpr double kPartOffset_m = 0.05;           // of the one from the line of the other
constexpr std::uint32_t kPartObservations = 20;  // of each of them
constexpr std::uint32_t kPartHidden =
    3;  // of the ends that face each other, with something in front of the rest
constexpr std::uint64_t kPartFrames = 30;  // since they were seen: their ends had their chance

}  // namespace

Index DuplicateFinder::duplicate_of(const WallMap& map, Index w, std::uint32_t known,
                                    std::uint64_t iteration) const {
  if (map.walls[w].merged_into != kNone || map.walls[w].is_dynamic || map.walls[w].count < least_count_)
    return kNone;
  const WallEstimate& wall = map.walls[w].estimate;
  Index duplicate = kNone;
  const auto look_at = [&](Index other) {
    if (other == w || map.walls[other].is_dynamic || map.walls[other].count < least_count_ ||
        other > duplicate)
      return;
    if ((map.walls[other].epoch < known) != (map.walls[w].epoch < known)) return;
    bool contradict = false;
    if (are_duplicates(map.walls[other].estimate, wall, Vec2::Zero(), bound_m_, kDuplicateSine, contradict) ||
        are_parts(map.walls[other], map.walls[w], iteration))
      duplicate = other;
  };
  for (const double share : {0.0, 0.5, 1.0}) {
    map.visit_near(wall.basis.point(wall.reach[kEndA] + share * (wall.reach[kEndB] - wall.reach[kEndA])),
                   look_at);
  }
  return duplicate;
}

/// Two walls out of view, on one line with a short overlap, or a short distance between which something hides.
bool DuplicateFinder::are_parts(const WallRecord& one, const WallRecord& other,
                                std::uint64_t iteration) const {
  if (std::min(one.count, other.count) < kPartObservations) return false;
  if (std::max(one.last_seen, other.last_seen) + kPartFrames > iteration) return false;
  const WallBasis& basis = one.estimate.basis;
  if (basis.differs(other.estimate.basis.direction, kDuplicateSine)) return false;
  const Vec2 end[2] = {other.estimate.extent(kEndA), other.estimate.extent(kEndB)};
  const double shorter = std::min(one.estimate.reach[kEndB] - one.estimate.reach[kEndA],
                                  other.estimate.reach[kEndB] - other.estimate.reach[kEndA]);
  for (int k = 0; k < 2; ++k) {  // the end of `one` that faces the other

    const double apart = outward(k) * (basis.along(end[1 - k]) - one.estimate.reach[k]);
    if (apart < -0.5 * shorter || apart > kPartDistance_m) continue;  // more overlap makes duplicates
    return !one.estimate.known[k] && !other.estimate.known[1 - k] &&
           (apart <= 0.0 || std::min(one.hidden[k], other.hidden[1 - k]) >= kPartHidden) &&
           std::abs(basis.across(end[1 - k])) < kPartOffset_m;
  }
  return false;
}

}  // namespace hallway::slam_plane
