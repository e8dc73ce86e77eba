// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

namespace hallway::eval {

/// How errors compare with the covariances stated for them: the mean of error^T covariance^-1 error per degree of freedom
/// (normalised estimation error squared; Bar-Shalom 2001, section 5.4). About 1 where the covariances are honest; above, they
/// promise too much.
class Consistency {
 public:
  /// Adds an error of up to six components. Components whose variance is exactly 0 are left out: nothing moves there. A
  /// covariance of the others that is not positive definite adds nothing.
  void add(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance);

  /// Errors added that count.
  std::uint64_t count() const { return count_; }
  /// The mean per degree of freedom; empty while nothing counts.
  std::optional<double> mean() const;

 private:
  double sum_ = 0.0;
  std::uint64_t freedom_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace hallway::eval
