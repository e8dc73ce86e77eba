// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

/// Dense linear algebra for oracles: what Eigen has, compiled once for all tests, since its solvers take a compiler longer than the tests that use them.
/// Apart from geometry/, which it checks.
namespace hallway::dense {

/// a * b.
Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// The inverse, by LU.
Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix);

/// matrix^-1 * right of a symmetric matrix, by LDL^T.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// Eigenvalues of a symmetric matrix, rising, and its eigenvectors, one a column.
struct Spectrum2 {
  Eigen::Vector2d values;
  Eigen::Matrix2d vectors;
};
Spectrum2 eigen_of(const Eigen::Matrix2d& matrix);
Eigen::Vector3d eigenvalues_of(const Eigen::Matrix3d& matrix);

/// Singular values, falling, and right singular vectors, one a column, of a matrix with at least as many rows as columns.
struct Singular {
  Eigen::VectorXd values;
  Eigen::MatrixXd right;
};
Singular singular_of(const Eigen::MatrixXd& matrix);

/// The rotation R for which the trace of R^T * cross is greatest, by singular values.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& cross);

/// The rigid motion that brings `from` nearest to `to`, points being columns, by Umeyama's closed form.
Eigen::Matrix4d rigid_motion(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to);

}  // namespace hallway::dense
