// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "sense/trajectory.hpp"

namespace hallway::sense {

using MotionSum = Eigen::Matrix<double, 6, 1>;

/// What a sensor sums up while its body moves: six numbers.
class MotionIntegrand {
 public:
  virtual ~MotionIntegrand() = default;
  /// What it adds per second.
  virtual MotionSum rate(const Kinematics& motion) const = 0;
  /// What it adds at a moment at which velocity, angular velocity or orientation jumps.
  virtual MotionSum jump(const Kinematics& before, const Kinematics& after) const = 0;
};

/// The orientation halfway between two, on the shortest turn.
Quat halfway(const Quat& before, const Quat& after);

/// The integral over (begin, end], with the jumps at the trajectory's breaks in it: a jump at `end` is in it, one at `begin` is in the interval before.
///
/// Between breaks by Gauss-Legendre quadrature with seven nodes and its Kronrod extension to fifteen (Piessens et al., QUADPACK, 1983). A panel is halved while
/// the two differ by more than 1e-10 of (1 + the largest number there), so the fifteen nodes are good to some 1e-14 of that. A smooth interval of a usual IMU
/// takes fifteen evaluations. A break that is not named is found by halving panels, at the cost of accuracy: some 1e-8 of the jump.
///
/// At a break the trajectory is asked with the number of seconds that breaks_in() gave, to the bit. Differences there below 1e-12 of (1 + the number) count
/// as rounding and are no jump.
///
/// Throws Error{kBadInput} that names the sensor and the interval: if the motion is not finite there, or if it changes too fast to be summed up in 2^18
/// panels. An empty interval gives 0. A pure function.
MotionSum integrate_motion(const Trajectory& trajectory, std::int64_t begin_ns, std::int64_t end_ns,
                           const MotionIntegrand& integrand, const std::string& sensor);

}  // namespace hallway::sense
