// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace hallway::algebra {

/// Eigenvalues of a symmetric matrix, rising, and its eigenvectors, one a column, of length 1 and in the same order.
template <int N>
struct Spectrum {
  Eigen::Matrix<double, N, 1> values;
  Eigen::Matrix<double, N, N> vectors;
};

/// The spectrum of a symmetric matrix of 2, 3 or 6 rows, of which the lower triangle is read. By iteration; allocates nothing. Compiled once, since
/// Eigen's solvers take a compiler longer than all else that uses them.
template <int N>
Spectrum<N> spectrum(const Eigen::Matrix<double, N, N>& matrix);

/// The smallest eigenvalue of a symmetric matrix of 3 rows, in closed form: faster than spectrum(), to some 1e-8 of the largest.
double least_eigenvalue(const Eigen::Matrix3d& matrix);

}  // namespace hallway::algebra
