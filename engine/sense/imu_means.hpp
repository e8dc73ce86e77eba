// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "sense/trajectory.hpp"

namespace hallway::sense {

/// Means over an interval, in the sensor's frame.
struct ImuMeans {
  Vec3 angular_rad_s = Vec3::Zero();
  Vec3 force_m_s2 = Vec3::Zero();  ///< specific force: at rest gravity's magnitude, upward
};

/// What a perfect IMU measures over (begin, end]. With T_world_body = (R, x), angular velocity w (body frame), mount T_body_sensor = (R_s, l) and gravity's
/// vector g = (0, 0, -gravity_m_s2) in the world:
///
///     angular = R_s^T mean(w)
///     force   = R_s^T mean(R^T (x'' - g) + w' × l + w × (w × l))
///
/// Frames turn while the mean is taken, as in hardware (coning and sculling are in it). A jump at a break enters as an impulse, divided by the duration:
///
/// - orientation, from R to R': the rotation vector of R^T R', of at most half a turn, is added to the integral of w;
/// - velocity of the sensor's place, v = x' + R (w × l), so also a jump of w through the lever arm: H^T (v' - v) is added to the integral of the force, where H
///   is the orientation halfway between R and R' (both the same where the orientation does not jump);
/// - position: a jump of the place itself, also by a jump of the orientation through the lever arm, adds nothing.
///
/// Throws Error{kBadInput} that names the sensor: as integrate_motion() does, and for an interval that is empty, of which there is no mean.
///
/// @param gravity_m_s2  magnitude
ImuMeans imu_means(const Trajectory& trajectory, std::int64_t begin_ns, std::int64_t end_ns,
                   const Pose& T_body_sensor, double gravity_m_s2, const std::string& sensor);

}  // namespace hallway::sense
