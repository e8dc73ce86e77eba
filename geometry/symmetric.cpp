// SPDX-License-Identifier: MIT
#include "geometry/symmetric.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace hallway {

template <int N>
Spectrum<N> spectrum(const Eigen::Matrix<double, N, N>& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

/// Of two rows, which are tridiagonal as they are. Eigen's reduction to that form changes no bit of them, and takes a compiler as long as that of six rows.
template <>
Spectrum<2> spectrum(const Eigen::Matrix2d& matrix) {
  const double largest = std::max({std::abs(matrix(0, 0)), std::abs(matrix(1, 0)), std::abs(matrix(1, 1))});
  const double scale = largest == 0.0 ? 1.0 : largest;  // as Eigen scales
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeFromTridiagonal(Eigen::Vector2d(matrix(0, 0) / scale, matrix(1, 1) / scale),
                                Eigen::Matrix<double, 1, 1>(matrix(1, 0) / scale));
  return {solver.eigenvalues() * scale, solver.eigenvectors()};
}

template Spectrum<3> spectrum(const Eigen::Matrix<double, 3, 3>&);
template Spectrum<6> spectrum(const Eigen::Matrix<double, 6, 6>&);
template Spectrum<Eigen::Dynamic> spectrum(const Eigen::MatrixXd&);

double least_eigenvalue(const Eigen::Matrix3d& matrix) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(matrix, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(0);
}

template <int N>
Inverse<N> inverse_of_positive(const Eigen::Matrix<double, N, N>& matrix) {
  const Eigen::LLT<Eigen::Matrix<double, N, N>> factor(matrix);
  return {factor.solve(Eigen::Matrix<double, N, N>::Identity()), factor.info() == Eigen::Success};
}

template Inverse<2> inverse_of_positive(const Eigen::Matrix<double, 2, 2>&);
template Inverse<3> inverse_of_positive(const Eigen::Matrix<double, 3, 3>&);
template Inverse<6> inverse_of_positive(const Eigen::Matrix<double, 6, 6>&);

template <int N>
Ldlt<N>::Ldlt(const Square& matrix) : factors_(matrix) {}

template <int N>
typename Ldlt<N>::Column Ldlt<N>::solve(const Column& right) const {
  return factors_.solve(right);
}

template <int N>
typename Ldlt<N>::Square Ldlt<N>::solve_all(const Square& right) const {
  return factors_.solve(right);
}

template <int N>
double Ldlt<N>::least_pivot() const {
  return factors_.vectorD().minCoeff();
}

template <int N>
double Ldlt<N>::largest_pivot() const {
  return factors_.vectorD().maxCoeff();
}

template class Ldlt<3>;
template class Ldlt<6>;
// No more than is used: products of matrices of any size would take as long to compile as all the rest.
template Ldlt<Eigen::Dynamic>::Ldlt(const Square&);
template Ldlt<Eigen::Dynamic>::Column Ldlt<Eigen::Dynamic>::solve(const Column&) const;

}  // namespace hallway
