// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/random.hpp"

namespace hallway::sense {

/// A Wiener process W on the grid k * interval, k = 0, 1, …, with W_0 = 0: the increments are independent and N(0, sigma^2 interval). Value k needs
/// no other value to be asked for before: it is made by dyadic subdivision (Lévy's construction), from deviates z keyed by places of the grid.
///
///     W_1 = s z_1                                     s = sigma sqrt(interval)
///     W_2p = W_p + s sqrt(p) z_2p                     where p is a power of two
///     W_m = (W_a + W_b) / 2 + s sqrt((b - a) / 4) z_m     where m is the middle of a dyadic interval [a, b] within [p, 2p]
///
/// Each place has one deviate, so any order of calls gives the same numbers.
class RandomWalk {
 public:
  /// @param random      keyed with `step` by what the walk is for
  /// @param sigma       per square root of a second, finite, not negative; 0: the walk is 0
  /// @param interval_s  from value to value, finite, not negative
  RandomWalk(const Random& random, std::uint32_t step, double sigma, double interval_s);

  /// W_k. O(log k): at most 2 log2(k) + 1 deviates. A pure function. Increments are exact to the rounding of W itself, 1e-16 of its size.
  double value(std::uint64_t k) const;

 private:
  Random random_;
  std::uint32_t step_;
  double scale_;  ///< standard deviation of an increment
};

}  // namespace hallway::sense
