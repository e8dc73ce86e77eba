// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bsp/enclosure.hpp"

namespace hallway::bsp {

/// Ways from everywhere to the void: for each open portal how far it is and which portal is next, over the portals' middles (Dijkstra).
class WaysOut {
 public:
  /// Keeps a reference to the space. O(portals log portals).
  WaysOut(const CellSpace& space, const std::vector<bool>& open);

  /// Length of the way from a place (metres) in a cell, nearly; infinite where there is none.
  double length_m(const Vec3& from_m, std::int32_t cell) const;
  /// The way, pulled tight within the portals that it passes, and the hole by which it leaves (find_opening()). There must be one.
  Leak find(const Vec3& from_m, std::int32_t cell) const;

 private:
  /// Ends a chain of portals in the first cell that touches the rim, by the nearest portal there: shortest over middles is not shortest where the
  /// portals are as large as the rim's.
  void end_at_rim(const Vec3& from_m, std::int32_t cell, std::vector<std::uint32_t>& chain) const;
  std::uint32_t nearest_rim_portal(const Vec3& from_m, std::int32_t cell) const;
  std::uint32_t first_portal(const Vec3& from_m, std::int32_t cell) const;

  const CellSpace& space_;
  std::vector<bool> open_;
  std::vector<std::vector<std::uint32_t>> of_cell_;  ///< open portals of each cell
  std::vector<Vec3> middle_;
  std::vector<double> best_;
  std::vector<std::uint32_t> next_;
};

}  // namespace hallway::bsp
