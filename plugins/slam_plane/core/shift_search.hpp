// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_plane/core/gap.hpp"
#include "slam_plane/core/wall_map.hpp"

namespace hallway::slam_plane {

/// Two walls that are one.
struct Duplicates {
  Index kept = kNone;
  Index gone = kNone;
};

/// Finds by how much the walls seen after a gap are displaced along its direction, when they come to lie among walls seen before it.
///
/// Each young wall and each old one that it may be vote for the displacement that makes them one: by the distance of their lines where these
/// cross the direction, by a corner where they run along it. A displacement is believed when enough walls agree on it, nearly no
/// corners contradict, and no other displacement has nearly as many votes: where a building repeats itself, one waits.
class ShiftSearch {
 public:
  explicit ShiftSearch(const Options& options);

  /// Looks for the displacement of `young` walls (of the gap's epoch or later). True: `step` moves them onto the old ones [m, map
  /// frame], and `duplicates` says which are one then. O(young * range), flat in the size of the map.
  bool find(const WallMap& map, const std::vector<Index>& young, const Gap& gap, Vec2& step,
            std::vector<Duplicates>& duplicates);

  /// Looks for the one old wall that a young wall across the direction can be: whose line and corner lie where the young one's do, if no other old wall's do at any displacement
  /// that the gap allows. `shift`: along the gap's direction [m]. kNone if there is none, or more than one. O(range), flat in the size of the map.
  Index only_duplicate(const WallMap& map, Index young, const Gap& gap, double& shift);

 private:
  enum class Kind { line, corner };
  struct Vote {
    double shift;
    Index young;
    Index old;
    Kind kind;
  };

  bool find_beside(const WallMap& map, const std::vector<Index>& young, const Gap& gap, Vec2& step,
                   std::vector<Duplicates>& duplicates);
  void vote(const WallMap& map, Index young, const Gap& gap);
  void vote(const WallMap& map, Index young, Index old, const Gap& gap);
  int support(std::size_t first, std::size_t end) const;
  int rival_support(double shift) const;

  double bound_;
  Vec2 across_ = Vec2::Zero();  // displacement across the gap that is tried
  double sine_;
  std::uint32_t least_count_;
  std::vector<Vote> votes_;
  std::vector<Index> seen_;
  mutable std::vector<std::pair<Index, Kind>> voters_;
};

/// Whether two walls of the map, the second moved by `step`, have lines and extents that agree. `contradict`: their lines and extents do, but
/// corners do not, so that they are two.
bool are_duplicates(const WallEstimate& wall, const WallEstimate& other, const Vec2& step, double bound_m,
                    double sine, bool& contradict);

}  // namespace hallway::slam_plane
