// SPDX-License-Identifier: MIT
#include "algebra/spectrum.hpp"

#include <Eigen/Eigenvalues>

namespace hallway::algebra {

template <int N>
Spectrum<N> spectrum(const Eigen::Matrix<double, N, N>& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template Spectrum<2> spectrum(const Eigen::Matrix<double, 2, 2>&);
template Spectrum<3> spectrum(const Eigen::Matrix<double, 3, 3>&);
template Spectrum<6> spectrum(const Eigen::Matrix<double, 6, 6>&);

double least_eigenvalue(const Eigen::Matrix3d& matrix) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(matrix, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(0);
}

}  // namespace hallway::algebra
