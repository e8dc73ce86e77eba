// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "icp/core/scan.hpp"

namespace hallway::icp {

/// How ranges err.
struct RangeNoise {
  double noise_m = 0.02;     ///< standard deviation of a range [m]
  double noise_per_m = 0.0;  ///< of its part that grows with the distance [1]

  double variance_at(double distance_m) const {
    const double far_m = noise_per_m * distance_m;
    return noise_m * noise_m + far_m * far_m;
  }
};

/// A flat piece of surface as one scan sees it: the plane inverse . x = 1 in the scanner's frame.
struct Surfel {
  Vec3 point = Vec3::Zero();       ///< on it, about its middle [m]
  Vec3 normal = Vec3::UnitZ();     ///< away from the scanner
  Vec3 inverse = Vec3::Zero();     ///< normal over distance [1/m]
  Mat3 covariance = Mat3::Zero();  ///< of the error of `inverse` [1/m^2]; singular where the scan is planar
  double variance = 0.0;           ///< of the error of `point` along the normal [m^2]
};

/// The surfels of a scan. Windows of three neighbouring rings (one, where the scan is planar) and some two degrees of turn are fitted by a plane: 1/range is linear in a ray's direction,
/// which is exact, so that the fit has no bias at any slant. A window counts where its rays lie on the plane up to their noise and a few centimetres of unevenness. Two rings would not do:
/// two lines are in one plane even where they lie on two surfaces. O(rays).
/// @param points  in the scanner's frame, deskewed
/// @param places  of each point's ray; rows and columns begin at 0, and several points may share a place
std::vector<Surfel> surfels_of(const Points& points, std::span<const GridPlace> places, bool planar,
                               const RangeNoise& noise);

}  // namespace hallway::icp
