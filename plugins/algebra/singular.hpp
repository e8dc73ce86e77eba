// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace hallway::algebra {

/// A matrix as left * diagonal(values) * right^T: left and right orthogonal, values falling and none below 0.
struct Singular {
  Eigen::Matrix3d left;
  Eigen::Vector3d values;
  Eigen::Matrix3d right;
};

/// The singular value decomposition, by Jacobi rotations; allocates nothing. Compiled once, as spectrum() is.
Singular singular(const Eigen::Matrix3d& matrix);

}  // namespace hallway::algebra
