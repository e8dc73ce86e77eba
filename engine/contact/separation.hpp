// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "contact/shape.hpp"
#include "geometry/se3.hpp"

namespace hallway::contact {

/// The corners of a triangle, metres, world frame. Its sides are alike, and it may be without area.
using Triangle = std::array<Vec3, 3>;

/// How far a body is from a triangle.
struct Separation {
  /// A lower bound of the distance, metres: `normal` . (p - q) >= gap for all points p of the body and q of the triangle, rounding
  /// included. 0 where they overlap or touch, and where no plane that separates them was found.
  double gap = 0.0;
  Vec3 normal = Vec3::UnitZ();  ///< unit, world frame, from the triangle to the body; of no meaning for gap 0
  Vec3 on_body = Vec3::Zero();  ///< the nearest point of the body, world frame; of no meaning for gap 0
  Vec3 on_triangle = Vec3::Zero();  ///< the nearest point of the triangle
};

/// The distance between a body at a pose and a triangle, by the algorithm of Gilbert, Johnson and Keerthi (1988).
///
/// It ends after at most 100 steps with the best bound found. Where they are apart, the bound of a polytope is below the distance by less than
/// 1e-9 of it and 1e-14 of the lengths at hand; that of a cylinder by up to 1e-10 m more. All is computed in the body's frame, so that the place in the
/// world does not matter. Never throws. O(vertices) a step, a few steps.
/// @param pose     T_world_body
/// @param towards  a direction from triangle to body to begin with, for speed; any length
Separation separate(const BodyShape& shape, const Pose& pose, const Triangle& triangle,
                    const Vec3& towards = Vec3::Zero());

/// The certified gap along a direction: at most min normal . (p - q) over the points p of the body and q of the triangle. It is negative where the plane does
/// not separate them.
/// @param normal  unit, world frame, from triangle to body
double gap_along(const BodyShape& shape, const Pose& pose, const Triangle& triangle, const Vec3& normal);

}  // namespace hallway::contact
