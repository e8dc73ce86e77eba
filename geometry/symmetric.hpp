// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>

/// Decompositions of small symmetric matrices, compiled once, since Eigen's solvers take a compiler longer than all else that uses them.
namespace hallway {

/// Eigenvalues of a symmetric matrix, rising, and its eigenvectors, one a column, of length 1 and in the same order.
template <int N>
struct Spectrum {
  Eigen::Matrix<double, N, 1> values;
  Eigen::Matrix<double, N, N> vectors;
};

/// The spectrum of a symmetric matrix of 2, 3, 6 or any number of rows (N is Eigen::Dynamic), of which the lower triangle is read. By iteration; only that of
/// any number of rows allocates. For three rows the two differ in rounding: Eigen takes another way to tridiagonal form.
template <int N>
Spectrum<N> spectrum(const Eigen::Matrix<double, N, N>& matrix);

/// The smallest eigenvalue of a symmetric matrix of 3 rows, in closed form: faster than spectrum(), to some 1e-8 of the largest.
double least_eigenvalue(const Eigen::Matrix3d& matrix);

/// The inverse of a symmetric matrix by its Cholesky factor. Where the matrix is not positive definite, `is_positive` is false and the inverse says nothing.
template <int N>
struct Inverse {
  Eigen::Matrix<double, N, N> matrix;
  bool is_positive;
};

/// Of a matrix of 2, 3 or 6 rows. Allocates nothing.
template <int N>
Inverse<N> inverse_of_positive(const Eigen::Matrix<double, N, N>& matrix);

/// The factors P^T L D L^T of a symmetric matrix of 3, 6 or any number of rows (N is Eigen::Dynamic), with pivoting: Eigen's LDLT. Factoring takes N^3 / 6
/// multiplications; only that of any number of rows allocates.
template <int N>
class Ldlt {
 public:
  using Square = Eigen::Matrix<double, N, N>;
  using Column = Eigen::Matrix<double, N, 1>;

  explicit Ldlt(const Square& matrix);

  Column solve(const Column& right) const;
  /// The same for as many columns as rows; of a fixed number of rows only, as is all that follows.
  Square solve_all(const Square& right) const;
  /// The inverse; 0 in directions that a semidefinite matrix leaves open.
  Square inverse() const { return solve_all(Square::Identity()); }

  /// Of the diagonal D. Both are positive exactly where the matrix is positive definite.
  double least_pivot() const;
  double largest_pivot() const;

 private:
  Eigen::LDLT<Square> factors_;
};

}  // namespace hallway
