// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/se3.hpp"

namespace hallway::map {

/// A curve at one point, with its derivatives by the length along it. World frame, metres.
struct CurvePoint {
  Vec3 position = Vec3::Zero();
  Vec3 tangent = Vec3::UnitX();         ///< unit
  Vec3 curvature = Vec3::Zero();        ///< of the tangent, 1/m
  Vec3 curvature_slope = Vec3::Zero();  ///< of the curvature, 1/m^2
};

/// Which side of a point where a derivative jumps is meant.
enum class CurveSide { kBefore, kAfter };

}  // namespace hallway::map
