// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geom/plane.hpp"

namespace hallway {

/// The visible part of a plane in one frame, as a sensor or a plane finder gives it. Sensor frame; metres, or the unit of a cloud.
struct PlaneObservation {
  static constexpr std::uint32_t kNoPlane = ~std::uint32_t{0};

  std::uint64_t id = 0;  ///< that a finder gave it
  /// Of a simulated sensor, index of its true plane, or kNoPlane for a false observation: for scoring, never for a plugin.
  std::uint32_t true_plane = 0;
  Plane plane{};  ///< normal towards the sensor: offset <= 0
  Vec3 centroid = Vec3::Zero();
  /// Counter-clockwise seen from where the normal points; of an upright rectangle left and right at the bottom, right and left at the
  /// top. Of a polygon a rectangle around it.
  std::array<Vec3, 4> corners{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  std::vector<Vec3> hull{};              ///< of a polygon: convex, on the plane, in that order; else empty
  std::vector<std::uint32_t> members{};  ///< points of the frame, ascending; empty where they are not given
  std::uint64_t points = 0;              ///< from how many points it was made
  double rms = 0.0;
  double exclusive_share = 0.0;
};

}  // namespace hallway
