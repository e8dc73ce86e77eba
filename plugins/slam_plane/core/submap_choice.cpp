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
  for (const Sighting& sighting : frame.sightings) {
    const Index member = map.walls[sighting.wall].active_member;
    if (member != kNone && submap.members[member].in_first_frame) ++shared;
  }
  const double all = static_cast<double>(frame.sightings.size() + submap.first_frame_size - shared);
  return shared < least * all;
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
  std::vector<std::pair<Index, std::uint32_t>> shared;
  for (const Sighting& sighting : frame.sightings) {
    for (const Membership& at : map.walls[sighting.wall].memberships) {
      const SubmapRecord& submap = map.submaps[at.submap];
      if (submap.lines_only || at.submap == map.active() || !submap.members[at.member].in_first_frame)
        continue;
      const auto found =
          std::find_if(shared.begin(), shared.end(), [&](const auto& s) { return s.first == at.submap; });
      if (found == shared.end()) {
        shared.emplace_back(at.submap, 1u);
      } else {
        ++found->second;
      }
    }
  }
  Index best = kNone;
  double best_overlap = options.overlap;
  for (const auto& [submap, count] : shared) {
    const double overlap =
        count / static_cast<double>(frame.sightings.size() + map.submaps[submap].first_frame_size - count);
    if (overlap > best_overlap || (overlap == best_overlap && submap < best)) {
      best = submap;
      best_overlap = overlap;
    }
  }
  return best;
}

}  // namespace hallway::slam_plane
