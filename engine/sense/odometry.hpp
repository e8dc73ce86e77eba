// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "geometry/planar_motion.hpp"
#include "geometry/se3.hpp"
#include "sense/trajectory.hpp"

namespace hallway::sense {

/// A motion in a plane over one interval, as an odometer measures it: x forward, y left, rotation; and how uncertain that is.
struct PlanarStep {
  Vec3 twist = Vec3::Zero();       ///< integral of the twist in the body's frame [m, m, rad]
  Mat3 covariance = Mat3::Zero();  ///< of `twist`; where `turn_is_known` is false, of x and y alone
  bool turn_is_known = true;       ///< false: the rotation in `twist` is 0 and says nothing
  bool way_is_known = true;        ///< false: x and y say nothing, and the rotation neither
};

/// What leaves the plane that an odometer takes its robot to move in: standard deviations per square root of a metre of way. The default is a level floor.
struct OffPlane {
  double height_m = 0.0;  ///< along z
  double tilt_rad = 0.0;  ///< about x and y
};

/// What plugins are given.
struct OdometryReading {
  Pose T_odom_sensor{};               ///< cumulative; identity at the start
  Vec3 linear_m_s = Vec3::Zero();     ///< mean of the interval, sensor frame; NaN: not measured
  Vec3 angular_rad_s = Vec3::Zero();  ///< the same
  /// Of the error of the increment since the reading before, in the sensor's frame at that reading: upper triangle, row by row, of x y z rx ry rz. Infinite
  /// variance: not measured; there the covariances are 0.
  std::array<double, 21> covariance{};
};

/// What plugins are not given.
struct OdometryTruth {
  Pose T_start_sensor{};   ///< the sensor since its start
  Pose T_before_sensor{};  ///< since the reading before
};

/// The increment that a twist makes that is constant over the interval: exp of se(2), level. Motion within the interval that is not of that form is not seen, an
/// error of second order in the interval's length that the covariance does not contain.
Pose motion_of(const PlanarStep& step);

/// The covariance of that increment (OdometryReading::covariance). Linear in the errors: right while they are small. Errors that
/// vary by 3 % of the way beside a resolution of 1/1000 of it have normalised squared errors 2 % above their number.
/// Rotation or way that is not known has infinite variance.
std::array<double, 21> covariance_of(const PlanarStep& step, const OffPlane& off_plane);

/// A reading: what the plane excludes (vertical motion, roll, pitch) is 0 in the twist, what the odometer cannot measure is NaN. An empty interval has no twist: NaN.
OdometryReading odometry_reading(const PlanarStep& step, const OffPlane& off_plane, const Pose& T_odom_sensor,
                                 double duration_s);

/// The true motion of a sensor. @param start_ns, before_ns, t_ns  its start, the reading before, and the reading
OdometryTruth odometry_truth(const Trajectory& trajectory, const Pose& T_body_sensor, std::int64_t start_ns,
                             std::int64_t before_ns, std::int64_t t_ns);

}  // namespace hallway::sense
