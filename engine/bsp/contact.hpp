// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "bsp/body_shape.hpp"
#include "csg/surface.hpp"

namespace hallway::bsp {

/// A polygon of the surface as a body sees it: relative to the body's position.
struct NearFace {
  Vec3 normal = Vec3::UnitZ();
  double offset = 0.0;  ///< normal . x of its plane
  std::vector<Vec3> corners{};
  std::vector<Vec3> edges{};  ///< unit directions of its edges, without repetitions along a straight line
};

/// Loads a polygon. False if nothing is left of it (csg::make_surface()).
bool load(const csg::Surface& surface, const csg::SurfacePolygon& polygon, const Vec3& position,
          NearFace& face);

/// How far a body is from a face.
struct Gap {
  double distance =
      0.0;  ///< metres; below zero: how far the body must move along `normal` to be clear of the face
  Vec3 normal = Vec3::UnitZ();  ///< unit; away from the face
};

/// Where a moving body meets a face.
struct Touch {
  double fraction = 0.0;        ///< of the motion
  Vec3 normal = Vec3::UnitZ();  ///< unit, away from the face; the body moves against it
};

/// The gap between a body and a face. For a ball it is the distance; for others that of the best separating plane: never more than the
/// distance, and the same unless a corner faces a corner.
Gap gap(const BodyShape& shape, const NearFace& face);

/// The first time from 0 to `limit` at which a body that moves by `motion` touches a face. A body that is in touch at the start
/// is met there if it moves deeper, else not at all.
///
/// Exact up to rounding for balls and boxes, and for cylinders against the inside of a face, level or upright edges against their
/// top and bottom, and level edges against their sides; where a cylinder meets another edge or a corner it counts as up to 0.22 % of its radius larger, as a
/// prism of 48 sides around it.
std::optional<Touch> first_touch(const BodyShape& shape, const NearFace& face, const Vec3& motion,
                                 double limit);

}  // namespace hallway::bsp
