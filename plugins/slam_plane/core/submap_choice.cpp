// SPDX-License-Identifier: MIT
#include "slam_plane/core/submap_choice.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace hallway::slam_plane {
namespace {

bool overlap_is_low(const WallMap& map, const Frame& frame, double least) {
  const SubmapRecord& submap = map.submaps[map.active()];
  std::uint32_t shared = 0;
  for (const AssociatedObservation& observation : frame.observations) {
    const Index member = map.walls[observation.wall].active_member;
    if (member != kNone && submap.members[member].in_first_frame) ++shared;
  }
  const double all = static_cast<double>(frame.observations.size() + submap.first_frame_size - shared);
  return shared < least * all;
}

/// Closed submaps, in their order, among which are all that began with a frame that overlaps these walls by `overlap` or more. Such a one has
/// that share of them, so that it has one of those few that are in the fewest submaps.
std::vector<Index> candidates(const WallMap& map, std::vector<Index> walls, double overlap) {
  const auto few = std::min(
      walls.size(), 1 + static_cast<std::size_t>((1.0 - overlap) * static_cast<double>(walls.size()) + 1e-9));
  std::partial_sort(
      walls.begin(), walls.begin() + static_cast<std::ptrdiff_t>(few), walls.end(), [&](Index a, Index b) {
        return std::pair(map.walls[a].memberships.size(), a) < std::pair(map.walls[b].memberships.size(), b);
      });
  std::vector<Index> found;
  for (std::size_t i = 0; i < few; ++i) {
    for (const Membership& at : map.walls[walls[i]].memberships) {
      if (at.submap != map.active() && !map.submaps[at.submap].lines_only) found.push_back(at.submap);
    }
  }
  make_set(found);
  return found;
}

}  // namespace

SubmapChoice choose_submap(const WallMap& map, const Frame& frame, const PoseInformation& own,
                           const Options& options) {
  const SubmapRecord& submap = map.submaps[map.active()];
  const bool full = submap.frames >= static_cast<std::uint32_t>(options.max_submap_frames);
  const bool determined = own.determined();
  if (submap.lines_only) {
    const bool linked = frame.in_submap.heading && frame.in_submap.open < 2;
    return {determined || !linked || full, !determined};
  }
  return {!frame.in_submap.determined() || full || overlap_is_low(map, frame, options.overlap), !determined};
}

Index old_submap(const WallMap& map, const Frame& frame, const Options& options) {
  std::vector<Index> seen;
  for (const AssociatedObservation& observation : frame.observations) seen.push_back(observation.wall);
  std::ranges::sort(seen);
  const auto n = static_cast<double>(seen.size());
  Index best = kNone;
  double best_overlap = options.overlap;
  for (const Index submap : candidates(map, seen, options.overlap)) {
    const SubmapRecord& record = map.submaps[submap];
    std::ptrdiff_t shared = 0;
    for (const Member& member : record.members) {
      if (!member.in_first_frame || member.wall == kNone) continue;
      const auto [first, end] = std::equal_range(seen.begin(), seen.end(), member.wall);
      shared += end - first;
    }
    const auto count = static_cast<double>(shared);
    const double overlap = count / (n + record.first_frame_size - count);
    if (overlap < best_overlap || (overlap == best_overlap && best != kNone)) continue;
    best = submap;
    best_overlap = overlap;
  }
  return best;
}

}  // namespace hallway::slam_plane
