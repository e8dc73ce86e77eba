// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/random.hpp"

namespace hallway::sense {

/// A stationary Gauss-Markov process of first order on the grid k * interval, k = 0, 1, …: every value is N(0, sigma^2), and two that are t apart have the
/// correlation exp(-t / tau). Value k needs no other value to be asked for before: it is made as RandomWalk's is. With r(h) = exp(-h interval / tau):
///
///     x_0 = sigma z_0',    x_1 = r(1) x_0 + sigma sqrt(1 - r(1)^2) z_1
///     x_2p = r(p) x_p + sigma sqrt(1 - r(p)^2) z_2p
///     x_m = r / (1 + r^2) (x_a + x_b) + sigma sqrt((1 - r^2) / (1 + r^2)) z_m,    r = r((b - a) / 2)
class GaussMarkov {
 public:
  /// @param random      keyed with `step` by what the process is for
  /// @param sigma       finite, not negative; 0: the process is 0
  /// @param tau_s       correlation time, finite, not negative; 0: values are independent
  /// @param interval_s  from value to value, finite, not negative; 0: all values are one
  GaussMarkov(const Random& random, std::uint32_t step, double sigma, double tau_s, double interval_s)
      : random_(random), step_(step), sigma_(sigma), tau_s_(tau_s), interval_s_(interval_s) {}

  /// x_k. O(log k). A pure function.
  double value(std::uint64_t k) const;

 private:
  double correlation(std::uint64_t apart) const;

  Random random_;
  std::uint32_t step_;
  double sigma_;
  double tau_s_;
  double interval_s_;
};

}  // namespace hallway::sense
