// SPDX-License-Identifier: MIT
#include "sense/odometry.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

namespace hallway::sense {
namespace {

/// sin(a) / a, (1 - cos a) / a and their derivatives: of the left Jacobian of SO(2).
struct TurnSeries {
  double sine, cosine, sine_slope, cosine_slope;
};

TurnSeries turn_series(double a) {
  constexpr double kSmall_rad = 0.02;  // below it the neglected terms are below 1e-16
  if (std::abs(a) < kSmall_rad) {
    const double a2 = a * a;
    return {1.0 - a2 / 6.0 * (1.0 - a2 / 20.0 * (1.0 - a2 / 42.0)),
            a / 2.0 * (1.0 - a2 / 12.0 * (1.0 - a2 / 30.0 * (1.0 - a2 / 56.0))),
            -a / 3.0 * (1.0 - a2 / 10.0 * (1.0 - a2 / 28.0)),
            0.5 - a2 / 8.0 * (1.0 - a2 / 18.0 * (1.0 - a2 / 40.0))};
  }
  const double s = std::sin(a), c = std::cos(a);
  return {s / a, (1.0 - c) / a, (c - s / a) / a, (s - (1.0 - c) / a) / a};
}

/// The derivative of (x, y, rotation) of the increment with respect to the twist.
Mat3 increment_jacobian(const Vec3& twist) {
  const TurnSeries v = turn_series(twist.z());
  Mat3 jacobian;
  jacobian << v.sine, -v.cosine, v.sine_slope * twist.x() - v.cosine_slope * twist.y(),  //
      v.cosine, v.sine, v.cosine_slope * twist.x() + v.sine_slope * twist.y(),           //
      0.0, 0.0, 1.0;
  return jacobian;
}

constexpr std::size_t upper_index(std::size_t row, std::size_t column) {
  return row * 6 - row * (row + 1) / 2 + column;
}

}  // namespace

Pose motion_of(const PlanarStep& step) {
  const Vec3& twist = step.twist;
  const TurnSeries v = turn_series(twist.z());
  return PlanarPose{v.sine * twist.x() - v.cosine * twist.y(), v.cosine * twist.x() + v.sine * twist.y(),
                    twist.z()}
      .level();
}

std::array<double, 21> covariance_of(const PlanarStep& step, const OffPlane& off_plane) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  constexpr std::array<std::size_t, 3> kPlace{0, 1, 5};  // of x, y, rz among the six
  std::array<double, 21> covariance{};
  const Mat3 jacobian = increment_jacobian(step.twist);
  Mat3 of_twist = step.covariance;
  if (!step.turn_is_known) {
    of_twist.row(2).setZero();
    of_twist.col(2).setZero();
  }
  const Mat3 planar = jacobian * of_twist * jacobian.transpose();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      const bool is_known = step.way_is_known && (step.turn_is_known || j < 2);
      const double value = planar(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      const double unknown = i == j ? kUnknown : 0.0;
      covariance.at(upper_index(kPlace[i], kPlace[j])) = is_known ? value : unknown;
    }
  }
  const double way_m = step.twist.head<2>().norm();
  covariance.at(upper_index(2, 2)) =
      step.way_is_known ? off_plane.height_m * off_plane.height_m * way_m : kUnknown;
  const double tilt = step.way_is_known ? off_plane.tilt_rad * off_plane.tilt_rad * way_m : kUnknown;
  covariance.at(upper_index(3, 3)) = covariance.at(upper_index(4, 4)) = tilt;
  return covariance;
}

OdometryReading odometry_reading(const PlanarStep& step, const OffPlane& off_plane, const Pose& T_odom_sensor,
                                 double duration_s) {
  constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
  OdometryReading reading{.T_odom_sensor = T_odom_sensor, .covariance = covariance_of(step, off_plane)};
  const bool has_twist = step.way_is_known && duration_s > 0.0;
  if (has_twist)
    reading.linear_m_s = Vec3(step.twist.x(), step.twist.y(), 0.0) / duration_s;
  else
    reading.linear_m_s.setConstant(kNotMeasured);
  if (has_twist && step.turn_is_known)
    reading.angular_rad_s = Vec3(0.0, 0.0, step.twist.z() / duration_s);
  else
    reading.angular_rad_s.setConstant(kNotMeasured);
  return reading;
}

OdometryTruth odometry_truth(const Trajectory& trajectory, const Pose& T_body_sensor, std::int64_t start_ns,
                             std::int64_t before_ns, std::int64_t t_ns) {
  const Pose now = trajectory.pose_at(t_ns) * T_body_sensor;
  const auto since = [&](std::int64_t then_ns) {
    return (trajectory.pose_at(then_ns) * T_body_sensor).inverse() * now;
  };
  return {since(start_ns), since(before_ns)};
}

}  // namespace hallway::sense
