// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>

namespace hallway::algebra {

/// The inverse of a symmetric matrix by its Cholesky factor. Where the matrix is not positive definite, `is_positive` is false and the inverse says nothing.
template <int N>
struct Inverse {
  Eigen::Matrix<double, N, N> matrix;
  bool is_positive;
};

/// Of a matrix of 2, 3 or 6 rows. Allocates nothing. Compiled once, as spectrum() is.
template <int N>
Inverse<N> inverse_of_positive(const Eigen::Matrix<double, N, N>& matrix);

/// The factors P^T L D L^T of a symmetric matrix of 3, 6 or any number of rows (N is Eigen::Dynamic), with pivoting: Eigen's LDLT, compiled once. Factoring
/// takes N^3 / 6 multiplications; only that of any number of rows allocates.
template <int N>
class Ldlt {
 public:
  using Square = Eigen::Matrix<double, N, N>;
  using Column = Eigen::Matrix<double, N, 1>;

  explicit Ldlt(const Square& matrix);

  Column solve(const Column& right) const;
  /// The same for as many columns as rows; of a fixed number of rows only, as are the pivots.
  Square solve_all(const Square& right) const;

  /// Of the diagonal D. Both are positive exactly where the matrix is positive definite.
  double least_pivot() const;
  double largest_pivot() const;

 private:
  Eigen::LDLT<Square> factors_;
};

}  // namespace hallway::algebra
