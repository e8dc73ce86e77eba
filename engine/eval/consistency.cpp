// SPDX-License-Identifier: MIT
#include "eval/consistency.hpp"

#include <Eigen/Cholesky>
#include <vector>

namespace hallway::eval {

void Consistency::add(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < error.size(); ++i) {
    if (covariance(i, i) != 0.0) free.push_back(i);
  }
  if (free.empty()) return;
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance(free, free));
  if (factor.info() != Eigen::Success) return;
  sum_ += factor.matrixL().solve(Eigen::VectorXd(error(free))).squaredNorm();
  freedom_ += free.size();
  ++count_;
}

std::optional<double> Consistency::mean() const {
  if (count_ == 0) return std::nullopt;
  return sum_ / static_cast<double>(freedom_);
}

}  // namespace hallway::eval
