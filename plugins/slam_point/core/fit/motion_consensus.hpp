// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_point/core/fit/robust_fit.hpp"

namespace hallway::slam_point {

/// The rigid motion that the largest set of pairs agrees on up to noise, where others may go other ways, alone or together: a fixed
/// number of motions of three pairs each (two in planar data) are tried beside the guess, and the best is fitted to all that
/// agree with it. Right with probability 0.995 while six in ten of the pairs agree. The same pairs in the same order give the
/// same bits.
class MotionConsensus {
 public:
  /// `noise_m`: standard deviation of one coordinate of a reference less its moved point.
  explicit MotionConsensus(double noise_m) : noise_m_(noise_m) {}

  /// From the guess `T`, within about 30 degrees of the answer. Returns how many pairs agree with the answer, which is put
  /// into `T`; 0, and `T` unchanged, when the pairs do not determine one. O(pairs).
  std::size_t fit(const std::vector<Pair>& pairs, const FitRules& rules, Pose& T) const;

 private:
  double score(const std::vector<Pair>& pairs, const Pose& T) const;
  bool refine(const std::vector<Pair>& pairs, const FitRules& rules, Pose& T) const;
  std::size_t count_agreeing(const std::vector<Pair>& pairs, const Pose& T) const;

  double noise_m_;
};

}  // namespace hallway::slam_point
