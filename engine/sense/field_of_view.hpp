// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "geometry/se3.hpp"

namespace hallway::sense {

/// The part of space around a sensor's origin, looking along x, that lies within its angles and ranges;
/// borders included.
///
/// If both angles are below 180 degrees it is a camera's pyramid: |y| <= x tan(horizontal / 2), |z| <= x
/// tan(vertical / 2). Otherwise it is a scanner's band: azimuth within +-horizontal / 2, elevation over the
/// x-y plane within +-vertical / 2 (no limit from 180 degrees on); the origin's vertical counts as azimuth 0.
class FieldOfView {
 public:
  /// @param horizontal, vertical  full angles in radians, above 0 and up to 2 pi
  /// @param min_range_m, max_range_m  Euclidean distances
  FieldOfView(double horizontal, double vertical, double min_range_m, double max_range_m);

  /// @param point  in the sensor's frame, metres
  bool contains(const Vec3& point) const {
    const double range_m = point.norm();
    if (range_m < min_range_m_ || range_m > max_range_m_) return false;
    return pyramid_ ? in_pyramid(point) : in_band(point);
  }

  bool is_pyramid() const { return pyramid_; }
  double horizontal() const { return horizontal_; }
  double vertical() const { return vertical_; }
  double min_range_m() const { return min_range_m_; }
  double max_range_m() const { return max_range_m_; }

 private:
  bool in_pyramid(const Vec3& point) const {
    return point.x() > 0.0 && std::abs(point.y()) <= point.x() * tan_horizontal_ &&
           std::abs(point.z()) <= point.x() * tan_vertical_;
  }
  bool in_band(const Vec3& point) const;

  double horizontal_;
  double vertical_;
  bool pyramid_;
  double tan_horizontal_;  ///< of half the angle; used by the pyramid
  double cos_horizontal_;  ///< of half the angle, below all others for a full turn; used by the band
  double tan_vertical_;    ///< of half the angle, infinite from 180 degrees on
  double min_range_m_;
  double max_range_m_;
};

}  // namespace hallway::sense
