// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sense/encoder_sensor.hpp"
#include "sense/odometry.hpp"
#include "sense/odometry_track.hpp"
#include "sense/timing.hpp"

namespace hallway::sense {

/// A driven wheel, in the body's frame.
struct OdometryWheel {
  Vec2 position_m = Vec2::Zero();  ///< of its contact with the floor
  /// The speed of the rim is the product of this with the velocity of the contact's place over the floor. A plain wheel: its rolling direction, of length 1. A
  /// mecanum wheel with rollers at 45 degrees: (1, -1) front left and rear right, (1, 1) front right and rear left.
  Vec2 rolling = Vec2::UnitX();
  bool holds_sideways = true;  ///< a plain wheel or a track; false: rollers let it slide
};

/// The wheels of a body with two wheels or tracks on its y axis: differential, tracked, and ackermann by its rear wheels. Left, right.
std::vector<OdometryWheel> two_odometry_wheels(double wheel_base_m);
/// The wheels of a body on four mecanum wheels: front left, front right, rear left, rear right.
std::vector<OdometryWheel> mecanum_odometry_wheels(double wheel_base_m, double axle_distance_m);

/// Odometry from encoders of wheels. Its frame is the body's.
struct WheelOdometrySpec {
  std::string name{};
  EncoderSensorSpec
      encoder{};  ///< the wheels that it counts; an encoder sensor of this name has the same wheels
  std::vector<OdometryWheel> wheels{};  ///< as the odometer knows them: nominal
  double turn_share = 1.0;  ///< of the wheels' turn that the body follows: 1 - turn_slip of tracks; (0, 1]
  /// Declared errors, for the covariance. Of a wheel's radius, a share, [0, 0.5]:
  double radius_sigma = 0.0;
  /// of the way of a wheel that the body does not follow, per square root of a metre of it, from 0 [m / sqrt(m)]. A slip of share sigma with correlation time tau
  /// at speed v has sigma sqrt(2 tau v);
  double slip = 0.0;
  double side_slip =
      0.0;  ///< of the body's sideways motion, per square root of a metre of way, from 0 [m / sqrt(m)]
  OffPlane off_plane{};
  SensorTiming timing{};
};

/// Turns ticks into motion: ways of rims by the nominal radius, the twist by least squares over the wheels (each rim's speed, and no sideways motion of wheels that
/// hold), the increment as exp of the twist.
///
/// The covariance of an increment has, for each wheel, independently, with c the way of a tick and d the way of the rim:
///
///     c^2 / 6 + (radius_sigma d)^2 + slip^2 |d|
///
/// and side_slip^2 way sideways. c^2 / 6 is the variance of the difference of two independent roundings. This holds where wheels turn by some ticks from
/// reading to reading. It does not: for a wheel that stands (its count is then exact, and the covariance too large); in the sum over readings
/// (roundings cancel, and radius errors, constant in a run, do not: c^2 / 6 sums up to too much, (radius_sigma d)^2 to too little); and on what is
/// not declared: slopes and steps, collisions that push, a wheel off the floor, slip with a mean.
class WheelOdometry {
 public:
  /// Throws Error{kBadInput} that names sensor and member: for a specification out of range, an encoder that EncoderSensor refuses, and wheels that do
  /// not determine a motion in the plane.
  WheelOdometry(WheelOdometrySpec spec, std::uint64_t seed);

  /// The wheels that are counted. Its read() turns the ways of rims into ticks.
  const EncoderSensor& encoder() const { return encoder_; }
  /// From one count to a later one. Throws Error{kBadInput} for another number of wheels. O(wheels).
  PlanarStep step(std::span<const std::int64_t> before, std::span<const std::int64_t> after) const;
  /// The reading after a step. @param T_odom_sensor  the product of motion_of() of all steps, e.g. of an OdometryTrack<Pose>
  OdometryReading reading(const PlanarStep& step, const Pose& T_odom_sensor, double duration_s) const {
    return odometry_reading(step, spec_.off_plane, T_odom_sensor, duration_s);
  }

  const WheelOdometrySpec& spec() const { return spec_; }

 private:
  WheelOdometrySpec spec_;
  EncoderSensor encoder_;
  std::vector<Vec3> gains_;  ///< of each wheel: twist for a metre of its rim
};

}  // namespace hallway::sense
