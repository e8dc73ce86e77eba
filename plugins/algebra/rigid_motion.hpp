// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace hallway::algebra {

/// The rigid motion, as a matrix, that brings the points of `from`, one a column, nearest to those of `to` in the least squares (Umeyama, PAMI 13 (1991)). At least
/// three points. Compiled once, as spectrum() is.
Eigen::Matrix4d rigid_motion(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to);

}  // namespace hallway::algebra
