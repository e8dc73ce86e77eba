// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/core/wall_map.hpp"

namespace hallway::slam_plane {

/// Finds walls of the map that are one: two that lie in one place, and two parts of one line between which something hides the rest.
class DuplicateFinder {
 public:
  explicit DuplicateFinder(const Options& options)
      : bound_m_(0.5 * options.match_bound_m),
        least_count_(static_cast<std::uint32_t>(options.min_observations)) {}

  /// The first wall that is the same as `wall`, kNone if there is none. Walls of epochs on different sides of `known` are not compared: where
  /// they lie to each other is not known. Flat in the size of the map.
  Index duplicate_of(const WallMap& map, Index wall, std::uint32_t known, std::uint64_t iteration) const;

 private:
  bool are_parts(const WallRecord& one, const WallRecord& other, std::uint64_t iteration) const;

  double bound_m_;
  std::uint32_t least_count_;
};

}  // namespace hallway::slam_plane
