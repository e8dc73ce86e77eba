// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "slam_plane/core/gap.hpp"
#include "slam_plane/core/shift_search.hpp"

namespace hallway::slam_plane {

/// By how much what came after a gap is displaced, and which walls are one then.
struct GapShift {
  Gap gap;
  Vec2 step = Vec2::Zero();  ///< [m], map frame
  std::vector<Duplicates> duplicates;
};

/// Looks for the end of open gaps: where what was seen since lies among what was seen before.
class GapSearch {
 public:
  explicit GapSearch(const Options& options)
      : search_(options),
        least_count_(static_cast<std::uint32_t>(options.min_observations)),
        expected_(options.map_bound_m) {}

  /// Takes note of the walls that are seen.
  void note_seen(const OpenGaps& gaps, const Frame& frame);

  /// Looks at a frame, and every tenth time at all that was seen lately. Two looks in a row must say the same before it is answered. Flat in
  /// the size of the map, but for the range of the gap.
  std::optional<GapShift> find(const WallMap& map, const OpenGaps& gaps, const Frame& frame);

 private:
  std::optional<GapShift> tie_by_corner(const WallMap& map, const Gap& gap, const Frame& frame);
  std::optional<GapShift> tie_by_wall(const WallMap& map, const Gap& gap, const Frame& frame);
  std::vector<Index> walls_since(const WallMap& map, const Gap& gap) const;

  ShiftSearch search_;
  std::uint32_t least_count_;
  double expected_;           // displacement that a single wall may tell [m]
  std::vector<Index> young_;  // walls seen lately, while there was a gap
  double seen_shift_ = 0.0;   // that the last look found
  bool has_seen_shift_ = false;
  int ties_ = 0;  // frames in a row that tell the same displacement by corners
  double tie_ = 0.0;
  int wall_ties_ = 0;  // likewise by a wall
  double wall_tie_ = 0.0;
};

}  // namespace hallway::slam_plane
