// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "geom/exact_plane.hpp"
#include "geom/polygon.hpp"

namespace hallway {

/// A side of a facet: it runs from `start` to the start of the next one, in `plane`.
struct FacetEdge {
  ExactPoint start;
  std::uint32_t plane = 0;
};

/// A convex polygon that is defined by planes: those it lies in and those its edges lie in. Cutting it makes no rounding errors, since
/// new corners are intersections of planes that were there before.
struct Facet {
  std::uint32_t plane = 0;  ///< in which it lies
  std::vector<FacetEdge>
      edges;  ///< counter-clockwise as seen from the front of `plane`; at least three, strictly convex

  bool empty() const { return edges.empty(); }
};

/// How a facet lies to a plane.
enum class FacetSide {
  kOn,     ///< in it
  kFront,  ///< in front, perhaps touching it
  kBack,   ///< behind, perhaps touching it
  kSplit,  ///< on both sides
};

/// The part of a plane within the cube |x|, |y|, |z| <= reach that matters: a quadrilateral that covers it.
Facet cover_plane(PlaneSet& planes, std::uint32_t plane, double reach);

FacetSide classify(const PlaneSet& planes, const Facet& facet, std::uint32_t plane);

/// Cuts a facet by a plane. Where it does not lie on both sides, it is moved whole to `front` or `back`, by the answer; kOn moves
/// nothing. `front` and `back` may not be `facet`.
FacetSide split(const PlaneSet& planes, Facet& facet, std::uint32_t plane, Facet& front, Facet& back);

/// Leaves of the facet what lies on one side (`keep_front`) of a plane; nothing if it only touches that side or lies in the plane.
void clip(const PlaneSet& planes, Facet& facet, std::uint32_t plane, bool keep_front);

/// Twice the area as a vector along the plane's normal, rounded.
Vec3 area_vector(const Facet& facet);

/// The least distance between two parallel lines of its plane that hold it between them, rounded.
double width(const PlaneSet& planes, const Facet& facet);

}  // namespace hallway
