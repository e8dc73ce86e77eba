// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>

#include "csg/boundary.hpp"

namespace hallway::csg {
namespace {

std::vector<Vec3> corners_in_units(const map::SolidFace& face, double metres_per_unit) {
  std::vector<Vec3> corners;
  corners.reserve(face.polygon.vertices.size());
  for (const Vec3& vertex : face.polygon.vertices) corners.push_back(vertex / metres_per_unit);
  return corners;
}

void add_planes(PlaneSet& planes, const map::Solid& solid, double metres_per_unit, ExactBrush& brush) {
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const std::vector<Vec3> corners = corners_in_units(solid.faces[f], metres_per_unit);
    for (const Vec3& corner : corners) brush.box.extend(corner);
    const OrientedPlane plane = planes.add(solid.faces[f].points, corners, kPlaneMerge);
    if (std::find(brush.planes.begin(), brush.planes.end(), plane) != brush.planes.end()) continue;
    brush.planes.push_back(plane);
    brush.faces.push_back(static_cast<std::uint32_t>(f));
  }
}

void add_facets(PlaneSet& planes, double reach, ExactBrush& brush) {
  for (const OrientedPlane& own : brush.planes) {
    Facet facet = cover_plane(planes, own.index, reach);
    for (const OrientedPlane& other : brush.planes) {
      if (facet.empty()) break;
      if (other.index == own.index) continue;
      clip(planes, facet, other.index, other.flipped);
    }
    brush.facets.push_back(std::move(facet));
  }
}

}  // namespace

ExactBrushes make_exact(const map::World& world) {
  ExactBrushes exact;
  exact.brushes.resize(world.solids.size());
  double reach = 1.0;
  // Structure first: detail takes over its planes and moves none of them.
  for (const bool detail : {false, true}) {
    for (std::size_t i = 0; i < world.solids.size(); ++i) {
      ExactBrush& brush = exact.brushes[i];
      brush.role = world.solids[i].role;
      if ((brush.role == map::BrushRole::kDetail) != detail) continue;
      brush.solid = static_cast<std::uint32_t>(i);
      add_planes(exact.planes, world.solids[i], world.metres_per_unit, brush);
      reach = std::max({reach, brush.box.min().cwiseAbs().maxCoeff(), brush.box.max().cwiseAbs().maxCoeff()});
    }
  }
  // A power of two, and far enough that no corner of a brush lies on the rim.
  exact.reach = std::exp2(std::ceil(std::log2(reach + 64.0)));
  for (ExactBrush& brush : exact.brushes) add_facets(exact.planes, exact.reach, brush);
  return exact;
}

}  // namespace hallway::csg
