// SPDX-License-Identifier: MIT
#include "support/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "geometry/rigid_fit.hpp"
#include "geometry/symmetric.hpp"

namespace hallway::dense {

Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a * b;
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix) {
  return matrix.inverse();
}

Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  return matrix.ldlt().solve(right);
}

Spectrum2 eigen_of(const Eigen::Matrix2d& matrix) {
  const auto found = hallway::spectrum<2>(matrix);
  return {found.values, found.vectors};
}

Eigen::Vector3d eigenvalues_of(const Eigen::Matrix3d& matrix) {
  return spectrum<3>(matrix).values;
}

Singular singular_of(const Eigen::MatrixXd& matrix) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.singularValues(), svd.matrixV()};
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& cross) {
  const hallway::Singular svd = singular(cross);
  const double sign = (svd.left * svd.right.transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return svd.left * Eigen::Vector3d(1.0, 1.0, sign).asDiagonal() * svd.right.transpose();
}

Eigen::Matrix4d rigid_motion(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  return hallway::rigid_motion(from, to);
}

}  // namespace hallway::dense
