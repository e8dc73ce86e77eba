// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bsp/enclosure.hpp"

namespace hallway::bsp {

/// What of a plane is empty around a point, with solid all around it.
struct Section {
  Plane plane;
  double area_m2 = 0.0;
  std::vector<Polygon> polygons{};  ///< convex pieces, one for each cell
};

/// Questions about the empty cells of a space, in metres. Portals that are not open count as solid.
class EmptySpace {
 public:
  /// Keeps references. O(portals).
  EmptySpace(const CellSpace& space, const std::vector<bool>& open);

  /// The section of a plane around one of its points, which lies in a cell. Empty where the plane's empty part reaches the rim, is larger than
  /// `most_m2`, or only touches the cell. O(cells that it passes).
  std::optional<Section> section(const Plane& plane, const Vec3& point, std::int32_t cell,
                                 double most_m2) const;

  /// Where a ray from a point in a cell meets solid.
  struct Hit {
    double distance_m = 0.0;
    Vec3 normal = Vec3::Zero();  ///< of the face, out of the solid
  };
  /// Empty where the ray reaches the rim. O(cells that it passes).
  std::optional<Hit> first_solid(const Vec3& from, std::int32_t cell, const Vec3& direction) const;

  /// The planes around a cell and around the solid cells beside it, metres, none twice.
  std::vector<Plane> planes_near(std::int32_t cell) const;

 private:
  Plane plane_of(std::uint32_t portal, std::int32_t cell) const;
  std::int32_t beyond(std::uint32_t portal, std::int32_t cell) const;
  void clip_to_cell(std::int32_t cell, std::vector<Vec3>& vertices) const;

  const CellSpace& space_;
  const std::vector<bool>& open_;
  std::vector<std::vector<std::uint32_t>> of_cell_;  ///< all portals of each cell
  std::vector<std::vector<Vec3>> corners_;           ///< of each portal
};

/// Sides, the lesser first, of the narrowest rectangle with an edge along one of the polygons' edges that holds them all. They
/// lie in one plane.
std::pair<double, double> sides_of_rectangle(const std::vector<Polygon>& polygons);

}  // namespace hallway::bsp
