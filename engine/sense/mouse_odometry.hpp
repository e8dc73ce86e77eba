// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "sense/odometry.hpp"
#include "sense/odometry_track.hpp"
#include "sense/timing.hpp"

namespace hallway::sense {

/// Where an optical mouse looks at the floor, in the sensor's x-y plane.
struct MousePlace {
  Vec2 position_m = Vec2::Zero();
  double heading_rad = 0.0;  ///< of its x axis, from the sensor's x towards y
};

/// Odometry from one or more optical mice (the robot of thesis section 2.2.3 has one).
struct MouseOdometrySpec {
  std::string name{};                  ///< keys the random numbers; unique on a robot
  Pose T_body_sensor{};                ///< in truth; z up from the floor
  std::vector<MousePlace> places{{}};  ///< at least one; one by itself must be at the origin
  double counts_per_m = 31496.06299;   ///< above 0; the default is 800 an inch
  double scale_sigma =
      0.0;  ///< of the share by which a mouse's scale is off, in truth and declared, [0, 0.1]
  double noise =
      0.0;  ///< of each axis of a mouse, per square root of a metre of its way, from 0 [m / sqrt(m)]
  double reach_m =
      0.003;  ///< greatest height above the floor at which a mouse counts; what lifts it is for the caller
  OffPlane off_plane{};
  SensorTiming timing{};
};

/// What the mice have counted since the start.
struct MouseState {
  std::vector<Vec2> way_m{};  ///< of each mouse, its frame: with scale error and noise
  std::vector<std::array<std::int64_t, 2>> counts{};  ///< floor(way * counts_per_m)
  std::vector<bool> lifted{};                         ///< whether it was in the interval before this reading
  PlanarStep step{};                                  ///< the increment before this reading
  Pose T_odom_sensor{};
};

/// Each mouse counts the motion of its place over the floor, in its own axes: the integral of its velocity in its x-y plane. Over reading k its way grows by
///
///     (1 + e) d + noise sqrt(|d|) z_k
///
/// with d the true displacement, e its scale error (constant, cut at 4 sigma) and z_k standard normal for each axis; its counts are floor(way * counts_per_m). A
/// mouse that is lifted in an interval counts nothing of it. It is the caller who knows the floor: it says for each interval which mice are higher than `reach_m`.
///
/// Increments are solved by least squares over the mice on the floor.
/// - Two mice or more at different places: x, y and rotation. The covariance has for each mouse (c^2 / 6 + noise^2 |d|) I + scale_sigma^2 d d^T, c the way of a
///   count. It holds and fails where that of WheelOdometry does: not for a mouse that stands, not in sums over readings, and not on what is not declared, such
///   as floors that a mouse does not see well.
/// - One mouse: no rotation. The pose keeps its orientation, and its position is the sum of increments in the mouse's own axes, as its counters have it: of use only
///   with a heading from elsewhere. The angular rate is NaN and the rotation's variance infinite.
/// - Of several mice one on the floor: the sensor's origin moves in a way that depends on the unknown rotation; all variances are infinite and the twist is
///   NaN. The pose goes on as if without rotation. The same with none on the floor, where the pose stays.
class MouseOdometry {
 public:
  /// Throws Error{kBadInput} that names sensor and member for a specification out of range.
  MouseOdometry(MouseOdometrySpec spec, std::uint64_t seed);

  /// Nothing counted.
  MouseState start() const;
  /// From reading k - 1 at `begin` to reading k at `end`, for an OdometryTrack<MouseState>. An orientation that jumps turns the places about the body's origin; a
  /// jump of position is not seen. Throws as integrate_motion() does, and Error{kBadInput} if `lifted` is neither empty nor one for each place.
  /// @param lifted  the mice that are higher than reach_m above the floor; empty: none
  void advance(MouseState& state, const Trajectory& trajectory, std::uint64_t k, std::int64_t begin_ns,
               std::int64_t end_ns, const std::vector<bool>& lifted = {}) const;
  OdometryReading reading(const MouseState& state, double duration_s) const {
    return odometry_reading(state.step, spec_.off_plane, state.T_odom_sensor, duration_s);
  }

  /// The true displacement of each mouse over an interval, in its frame [m].
  std::vector<Vec2> displacements(const Trajectory& trajectory, std::int64_t begin_ns,
                                  std::int64_t end_ns) const;
  /// The scale error of each mouse, in truth.
  const std::vector<double>& scale_errors() const { return scale_errors_; }
  const MouseOdometrySpec& spec() const { return spec_; }

 private:
  PlanarStep solve(std::span<const Vec2> ways, const std::vector<bool>& lifted) const;

  MouseOdometrySpec spec_;
  Random random_;
  std::vector<double> scale_errors_{};
};

}  // namespace hallway::sense
