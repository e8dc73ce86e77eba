// SPDX-License-Identifier: MIT
#include "geom/symmetric.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace hallway {

template <int N>
Spectrum<N> spectrum(const Eigen::Matrix<double, N, N>& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{
      Eigen::MatrixXd(matrix)};  // one solver for all sizes
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template <int N>
Eigen::Matrix<double, N, N> symmetric_inverse(const Eigen::Matrix<double, N, N>& matrix) {
  const Eigen::LDLT<Eigen::MatrixXd> factor{Eigen::MatrixXd(matrix)};
  return factor.solve(Eigen::MatrixXd::Identity(N, N));
}

template Spectrum<2> spectrum(const Eigen::Matrix<double, 2, 2>&);
template Spectrum<3> spectrum(const Eigen::Matrix<double, 3, 3>&);
template Spectrum<6> spectrum(const Eigen::Matrix<double, 6, 6>&);
template Eigen::Matrix<double, 3, 3> symmetric_inverse(const Eigen::Matrix<double, 3, 3>&);
template Eigen::Matrix<double, 6, 6> symmetric_inverse(const Eigen::Matrix<double, 6, 6>&);

}  // namespace hallway
