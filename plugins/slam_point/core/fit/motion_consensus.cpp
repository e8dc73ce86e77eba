// SPDX-License-Identifier: MIT
#include "slam_point/core/fit/motion_consensus.hpp"

#include <algorithm>
#include <cstdint>

#include "slam_point/core/fit/alignment.hpp"

namespace hallway::slam_point {
namespace {

constexpr int kTrials = 24;
constexpr int kRefinements = 3;
constexpr double kTrialNoises2 = 36.0;      // squared; a motion of three pairs is uncertain itself
constexpr double kAgreementNoises2 = 16.0;  // squared: 1 in 1000 is farther off

/// A fixed sequence of numbers that look drawn.
class Sequence {
 public:
  std::size_t below(std::size_t count) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::size_t>(state_ >> 33) % count;
  }

 private:
  std::uint64_t state_ = 1;
};

double distance2(const Pair& pair, const Mat3& rotation, const Vec3& translation) {
  return pair.weight * (pair.reference - rotation * pair.point - translation).squaredNorm();
}

}  // namespace

std::size_t MotionConsensus::fit(const std::vector<Pair>& pairs, const FitRules& rules, Pose& T) const {
  const std::size_t least = rules.least_pairs();
  if (pairs.size() < least) return 0;
  Pose best = T;
  double best_score = score(pairs, T);
  Sequence sequence;
  for (int trial = 0; trial < kTrials; ++trial) {
    Alignment few(T);
    for (std::size_t i = 0; i < least; ++i) {
      const Pair& pair = pairs[sequence.below(pairs.size())];
      few.add(pair.reference, pair.point, pair.weight);
    }
    Pose candidate;
    if (!few.solve(rules, candidate)) continue;
    const double reached = score(pairs, candidate);
    if (reached <= best_score) continue;
    best_score = reached;
    best = candidate;
  }
  for (int i = 0; i < kRefinements; ++i) {
    if (!refine(pairs, rules, best)) return 0;
  }
  T = best;
  return count_agreeing(pairs, T);
}

double MotionConsensus::score(const std::vector<Pair>& pairs, const Pose& T) const {
  const Mat3 rotation = T.q.toRotationMatrix();
  const double bound2 = kTrialNoises2 * noise_m_ * noise_m_;
  double sum = 0.0;
  for (const Pair& pair : pairs) sum += std::max(0.0, 1.0 - distance2(pair, rotation, T.t) / bound2);
  return sum;
}

bool MotionConsensus::refine(const std::vector<Pair>& pairs, const FitRules& rules, Pose& T) const {
  const Mat3 rotation = T.q.toRotationMatrix();
  const double bound2 = kTrialNoises2 * noise_m_ * noise_m_;
  Alignment all(T);
  for (const Pair& pair : pairs) {
    const double share = 1.0 - distance2(pair, rotation, T.t) / bound2;
    if (share > 0.0) all.add(pair.reference, pair.point, pair.weight * share * share);
  }
  return all.pairs() >= rules.least_pairs() && all.solve(rules, T);
}

std::size_t MotionConsensus::count_agreeing(const std::vector<Pair>& pairs, const Pose& T) const {
  const Mat3 rotation = T.q.toRotationMatrix();
  const double bound2 = kAgreementNoises2 * noise_m_ * noise_m_;
  return static_cast<std::size_t>(std::count_if(pairs.begin(), pairs.end(), [&](const Pair& pair) {
    return distance2(pair, rotation, T.t) <= bound2;
  }));
}

}  // namespace hallway::slam_point
