// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace hallway {

/// Eigenvalues of a symmetric matrix, rising, and its eigenvectors, one a column, of length 1 and in the same order.
template <int N>
struct Spectrum {
  Eigen::Matrix<double, N, 1> values;
  Eigen::Matrix<double, N, N> vectors;
};

/// The spectrum of a symmetric matrix, of which the lower triangle is read. Of 2, 3 and 6 rows: compiled once, since Eigen's solvers take a compiler
/// longer than all else that uses them. Not for inner loops: it allocates.
template <int N>
Spectrum<N> spectrum(const Eigen::Matrix<double, N, N>& matrix);

/// The inverse of a symmetric positive definite matrix; of 3 and 6 rows. With 0 as diagonal element of the factor (semidefinite), what Eigen's LDLT makes of
/// it: 0 in directions that are open.
template <int N>
Eigen::Matrix<double, N, N> symmetric_inverse(const Eigen::Matrix<double, N, N>& matrix);

}  // namespace hallway
