// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "bsp/exact_portals.hpp"
#include "bsp/exact_tree.hpp"
#include "geom/polygon.hpp"

namespace hallway::bsp {

/// The hole by which a way leaves the inside: flat, with solid all around it. Where there is no such hole on the way, `polygons` is empty
/// and height_m is 0; width_m is then that of the narrowest gap that was found between two faces, or 0.
struct Opening {
  Vec3 at = Vec3::Zero();           ///< its middle, metres; of a gap, where the way passes it
  double width_m = 0.0;             ///< the lesser side of the rectangle that holds it
  double height_m = 0.0;            ///< the greater
  std::vector<Polygon> polygons{};  ///< convex pieces that together are the opening

  bool is_measured() const { return !polygons.empty(); }
};

/// A way from an occupant of a world into the void around it.
struct Leak {
  std::size_t occupant = 0;  ///< index in what find_enclosure() was given
  std::vector<Vec3>
      way{};  ///< polyline in empty space (detail aside), metres: from the occupant to the rim of the void
  double length_m = 0.0;  ///< of the way
  Opening narrowest{};
};

/// Whether a world keeps its occupants from the void.
struct Enclosure {
  bool sealed = false;                  ///< an occupant stands in empty space, and the void reaches none
  std::vector<bool> outside{};          ///< for each cell: it is empty and the void reaches it
  std::vector<std::size_t> in_solid{};  ///< occupants that stand in solid
  std::vector<std::size_t> leaking{};   ///< occupants that reach the void
  std::optional<Leak> leak{};           ///< of the leaking occupant with the shortest way out
};

/// Where cells and portals are, for the search.
struct CellSpace {
  const PlaneSet& planes;
  const ExactTree& tree;
  const std::vector<ExactPortal>& portals;  ///< of the cells
  double metres_per_unit = 1.0;
};

/// Floods the empty cells from the void and looks who gets wet (thesis 2.3.1: no holes in the map). A portal narrower than `narrowest_m` counts as
/// closed: it comes from rounded coordinates. An occupant on a surface counts as in the empty space beside it.
/// O(portals log portals).
Enclosure find_enclosure(const CellSpace& space, const std::vector<Vec3>& occupants_m, double narrowest_m);

}  // namespace hallway::bsp
