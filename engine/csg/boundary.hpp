// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "geom/box.hpp"
#include "geom/facet.hpp"
#include "map/world.hpp"

namespace hallway::csg {

/// A piece of the boundary between solid and empty, in exact form and map units.
struct BoundaryFacet {
  Facet facet;
  bool flipped = false;     ///< the empty side is behind the facet's plane, not in front of it
  std::uint32_t solid = 0;  ///< index in map::World::solids
  std::uint32_t face = 0;   ///< index in Solid::faces
};

/// A brush as exact planes and facets, in map units.
struct ExactBrush {
  map::BrushRole role = map::BrushRole::kAdd;
  std::uint32_t solid = 0;            ///< index in map::World::solids
  std::vector<OrientedPlane> planes;  ///< normals outward, no two alike
  std::vector<Facet> facets;          ///< of each plane; empty where it only touches the brush
  std::vector<std::uint32_t> faces;   ///< of each plane, index in Solid::faces
  Box box;
};

/// The brushes of a world on shared planes.
struct ExactBrushes {
  PlaneSet planes;
  std::vector<ExactBrush> brushes;  ///< in the order in which they are applied
  double reach = 0.0;               ///< all lie within |x|, |y|, |z| < reach
};

/// Brushes whose planes differ by less than this over a face share one plane; map units.
inline constexpr double kPlaneMerge = 1e-6;

/// The solids of a world in exact form. A brush that nothing is left of once its planes are merged has no facets. O(sum of squares of the
/// brushes' face counts).
ExactBrushes make_exact(const map::World& world);

/// Which brushes take part.
enum class Parts {
  kStructure,  ///< without detail
  kAll,
};

/// The boundary of what the brushes leave solid, applied in order: a point is solid if the last brush that holds it adds. Interior
/// faces are gone; where faces of several brushes coincide the last brush has the face; every facet lies in a plane of a brush. Pieces of one
/// face that together are convex are one facet. Hint brushes take no part.
///
/// Exact: the facets together are the whole boundary and overlap nowhere. O(n k) for n faces that meet k brushes each.
std::vector<BoundaryFacet> boundary(const ExactBrushes& brushes, Parts parts);

}  // namespace hallway::csg
