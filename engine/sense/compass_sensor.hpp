// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "geometry/se3.hpp"
#include "sense/timing.hpp"
#include "sense/trajectory.hpp"

namespace hallway::sense {

/// What turns compasses that are near: iron, cables, loudspeakers.
struct Magnet {
  Vec3 position = Vec3::Zero();  ///< world [m]
  double reach_m = 1.0;          ///< where its field has faded to nothing, above 0
  double strength =
      0.5;  ///< of its field at its place, in units of the horizontal part of the Earth's; negative: it pulls
};

/// The horizontal magnetic field at a point, in units of the Earth's horizontal part: north plus, of each magnet, strength (1 - (d / reach)^2)^2 level and away from it, where its
/// distance d is below its reach; straight above or below a magnet it has no such part. The field of a dipole has other directions; this has one's size and smoothness.
Vec2 level_field(double north_rad, const std::vector<Magnet>& magnets, const Vec3& point);

/// A compass.
struct CompassSpec {
  std::string name{};           ///< keys the random numbers; unique on a robot
  Pose T_body_sensor{};         ///< in truth
  double north_rad = 0.0;       ///< of the magnetic north, from the world's x axis towards y
  double noise_rad = 0.0;       ///< standard deviation, from 0
  double bias_sigma_rad = 0.0;  ///< of an error that is the same in all readings, from 0
  std::vector<Magnet> magnets{};
  SensorTiming timing{};
};

/// What plugins are given.
struct CompassReading {
  double heading_rad =
      0.0;  ///< of the sensor's x axis from magnetic north, towards its left, in (-pi, pi]; NaN where the axis is upright or the field has no level part
  double variance_rad2 = 0.0;  ///< of noise and bias; no disturbance is known to a compass
};

/// What plugins are not given.
struct CompassTruth {
  double heading_rad = 0.0;    ///< from the north that is undisturbed; NaN where the axis is upright
  double deviation_rad = 0.0;  ///< of the field by magnets, towards y
  double bias_rad = 0.0;
};

/// Measures which way it points. Left out: tilt of a compass that is not levelled, iron that the robot carries and that turns with it, currents of motors.
class CompassSensor {
 public:
  /// Throws Error{kBadInput} that names the sensor and the member for a specification out of range.
  CompassSensor(CompassSpec spec, std::uint64_t seed);

  /// Reading `number` at a time, any order. O(magnets). Throws Error{kBadInput} for a pose that is not finite.
  void read(std::uint32_t number, std::int64_t t_ns, const Trajectory& trajectory, CompassReading& reading,
            CompassTruth& truth) const;

  const CompassSpec& spec() const { return spec_; }

 private:
  CompassSpec spec_;
  Random random_;
  double bias_rad_;
};

}  // namespace hallway::sense
