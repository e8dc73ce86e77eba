// SPDX-License-Identifier: MIT
#include "algebra/rigid_motion.hpp"

#include <Eigen/Geometry>

namespace hallway::algebra {

Eigen::Matrix4d rigid_motion(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  return Eigen::umeyama(from, to, false);
}

}  // namespace hallway::algebra
