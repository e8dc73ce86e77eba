// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "geom/plane.hpp"

namespace hallway::map {

/// A closed convex body with shared vertices.
struct ConvexBody {
  struct Side {
    std::size_t plane;                ///< index of its plane
    std::vector<std::uint32_t> loop;  ///< vertices, counter-clockwise from outside
  };
  std::vector<Vec3> vertices;
  std::vector<Side> sides;  ///< ordered by plane
};

/// Why half-spaces do not make a body.
enum class ConvexFault {
  kEmpty,      ///< nothing thicker than the tolerance lies behind all planes
  kUnbounded,  ///< what lies behind all planes has no end, or reaches beyond `reach`
  kUnstable,   ///< planes so nearly alike that rounding decides the shape
};

/// The body behind all planes: a large cube is cut by one plane after the other. Vertices within `tolerance` of a plane
/// count as on it, and edges shorter than that are contracted, so that neighbouring sides always share their vertices.
/// Vertices are recomputed at the end from the three of their planes that meet at the best angle. Planes that touch the
/// body in less than an area have no side.
///
/// @param reach      half the edge of the cube that must hold the body, around the origin
/// @param tolerance  in the unit of the planes
/// O(planes * vertices).
std::variant<ConvexBody, ConvexFault> intersect_half_spaces(std::span<const Plane> planes, double reach,
                                                            double tolerance);

}  // namespace hallway::map
