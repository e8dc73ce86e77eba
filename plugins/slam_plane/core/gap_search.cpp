// SPDX-License-Identifier: MIT
#include "slam_plane/core/gap_search.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::slam_plane {
namespace {

constexpr std::uint64_t kYoungFrames =
    100;  // for which a wall out of view is one whose place among old ones is sought
constexpr std::size_t kMostYoung = 12;       // walls that are looked for
constexpr std::uint64_t kSearchPeriod = 10;  // frames between looks
constexpr double kAlongGap = 0.7;            // cosine between a wall and a gap whose corners tell of it
constexpr double kAcrossGap = 0.7;           // sine between them, if its line does
constexpr std::uint64_t kWallPeriod = 5;     // frames between looks at one wall alone
constexpr int kTies = 3;                     // looks in a row that agree

}  // namespace

void GapSearch::note_seen(const OpenGaps& gaps, const Frame& frame) {
  if (gaps.empty()) return;
  for (const AssociatedObservation& observation : frame.observations) add_new(young_, observation.wall);
}

std::optional<GapShift> GapSearch::find(const WallMap& map, const OpenGaps& gaps, const Frame& frame) {
  if (gaps.empty()) {
    young_.clear();
    return std::nullopt;
  }
  if (std::optional<GapShift> shift = tie_by_corner(map, gaps.last(), frame)) return shift;
  if (std::optional<GapShift> shift = tie_by_wall(map, gaps.last(), frame)) return shift;
  if (frame.iteration % kSearchPeriod != 0) return std::nullopt;
  std::erase_if(young_, [&](Index w) {
    const WallRecord& wall = map.walls[w];
    return wall.merged_into != kNone || wall.last_seen + kYoungFrames < frame.iteration;
  });
  for (auto gap = gaps.all().rbegin(); gap != gaps.all().rend(); ++gap) {
    if (!gap->is_wide()) continue;
    const std::vector<Index> young = walls_since(map, *gap);
    GapShift found{*gap, Vec2::Zero(), {}};
    if (young.empty() || !search_.find(map, young, *gap, found.step, found.duplicates)) continue;
    const double shift = found.step.dot(gap->direction);
    const bool again = has_seen_shift_ && std::abs(shift - seen_shift_) < Gap::kBridged_m;
    has_seen_shift_ = !again;
    seen_shift_ = shift;
    if (!again) return std::nullopt;
    return found;
  }
  has_seen_shift_ = false;
  return std::nullopt;
}

/// Those that are looked for: the newest.
std::vector<Index> GapSearch::walls_since(const WallMap& map, const Gap& gap) const {
  std::vector<Index> young;
  for (const Index w : young_) {
    if (map.walls[w].epoch >= gap.epoch && map.walls[w].count >= least_count_ && !map.walls[w].is_dynamic)
      young.push_back(w);
  }
  if (young.size() > kMostYoung) {
    std::ranges::stable_sort(
        young, [&](Index a, Index b) { return map.walls[a].last_seen > map.walls[b].last_seen; });
    young.resize(kMostYoung);
  }
  return young;
}

/// A wall that was in view all through the last gap shows a corner that is known from before it: that tells how far the robot went,
/// once a few frames agree.
std::optional<GapShift> GapSearch::tie_by_corner(const WallMap& map, const Gap& gap, const Frame& frame) {
  const double most = gap.range_m + Gap::kBridged_m;
  double nearest = most;
  for (const AssociatedObservation& observation : frame.observations) {
    const WallRecord& wall = map.walls[observation.wall];
    const double along = wall.estimate.basis.direction.dot(gap.direction);
    if (observation.outlier || wall.epoch >= gap.epoch || std::abs(along) < kAlongGap) continue;
    for (int k = 0; k < 2; ++k) {
      if (!wall.estimate.known[k] || !observation.corner[k] || wall.corner_epoch[k] >= gap.epoch) continue;
      const double place = wall.estimate.basis.along(frame.T_map_robot * observation.end[k]);
      const double shift = (wall.estimate.end[k] - place) / along;
      if (std::abs(shift) < std::abs(nearest)) nearest = shift;
    }
  }
  if (std::abs(nearest) >= most) {
    ties_ = 0;
    return std::nullopt;
  }
  ties_ = ties_ > 0 && std::abs(nearest - tie_) < Gap::kBridged_m ? ties_ + 1 : 1;
  tie_ = nearest;
  if (ties_ < kTies) return std::nullopt;
  ties_ = 0;
  return GapShift{gap, nearest * gap.direction, {}};
}

/// A young wall across a gap with a corner lies where the map had one such wall before, about where it is expected, and no other one that it could be: once a few
/// frames agree, the two are one.
std::optional<GapShift> GapSearch::tie_by_wall(const WallMap& map, const Gap& gap, const Frame& frame) {
  if (!gap.is_wide() || frame.iteration % kWallPeriod != 0) return std::nullopt;
  Duplicates duplicates;
  double nearest = expected_;
  for (const AssociatedObservation& observation : frame.observations) {
    const WallRecord& wall = map.walls[observation.wall];
    const WallEstimate& estimate = wall.estimate;
    if (observation.outlier || wall.epoch < gap.epoch || wall.count < least_count_) continue;
    if (std::abs(cross(estimate.basis.direction, gap.direction)) < kAcrossGap) continue;
    bool corner = false;
    for (int k = 0; k < 2; ++k) corner = corner || (estimate.known[k] && observation.corner[k]);
    double shift = 0.0;
    const Index old = corner ? search_.only_duplicate(map, observation.wall, gap, shift) : kNone;
    if (old == kNone || std::abs(shift) >= std::abs(nearest)) continue;
    nearest = shift;
    duplicates = {old, observation.wall};
  }
  const bool again = wall_ties_ > 0 && std::abs(nearest - wall_tie_) < Gap::kBridged_m;
  wall_ties_ = duplicates.gone == kNone ? 0 : again ? wall_ties_ + 1 : 1;
  wall_tie_ = nearest;
  if (wall_ties_ < kTies) return std::nullopt;
  wall_ties_ = 0;
  return GapShift{gap, nearest * gap.direction, {duplicates}};
}

}  // namespace hallway::slam_plane
