// SPDX-License-Identifier: MIT
#include "algebra/singular.hpp"

#include <Eigen/SVD>

namespace hallway::algebra {

Singular singular(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

}  // namespace hallway::algebra
