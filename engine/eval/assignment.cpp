// SPDX-License-Identifier: MIT
#include "eval/assignment.hpp"

#include <limits>

namespace hallway::eval {
namespace {

constexpr double kUnreached = std::numeric_limits<double>::infinity();
constexpr double kShorter = 1e-12;  ///< a path must be shorter by that: rounding must not make a cycle of two

/// The assignment as it grows.
class Matching {
 public:
  Matching(std::size_t lefts, std::size_t rights, const std::vector<CandidatePair>& candidates)
      : candidates_(candidates), right_of_(lefts), left_of_(rights) {}

  /// Adds a pair by the cheapest path of pairs that are taken up and given up in turn; false if there is none.
  bool augment() {
    const std::vector<double> cost = find_paths();
    std::optional<std::size_t> end;
    for (std::size_t right = 0; right < left_of_.size(); ++right) {
      if (left_of_[right] || cost[right] == kUnreached) continue;
      if (!end || cost[right] < cost[*end]) end = right;
    }
    if (!end) return false;
    std::optional<std::size_t> right = end;
    while (right) {
      const std::size_t left = candidates_[reached_by_[*right]].left;
      const std::optional<std::size_t> given_up = right_of_[left];
      right_of_[left] = *right;
      left_of_[*right] = left;
      right = given_up;
    }
    return true;
  }

  const std::vector<std::optional<std::size_t>>& pairs() const { return right_of_; }

 private:
  /// The cost of the cheapest path to each right item from any free left one.
  std::vector<double> find_paths() {
    std::vector<double> to_left(right_of_.size(), kUnreached), to_right(left_of_.size(), kUnreached);
    for (std::size_t left = 0; left < right_of_.size(); ++left) {
      if (!right_of_[left]) to_left[left] = 0.0;
    }
    reached_by_.assign(left_of_.size(), 0);
    std::vector<double> pair_cost(right_of_.size(), 0.0);
    for (const CandidatePair& pair : candidates_) {
      if (right_of_[pair.left] == pair.right) pair_cost[pair.left] = pair.cost;
    }
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < candidates_.size(); ++i) {
        const CandidatePair& pair = candidates_[i];
        if (right_of_[pair.left] == pair.right) continue;
        const double cost = to_left[pair.left] + pair.cost;
        if (!(cost < to_right[pair.right] - kShorter)) continue;
        to_right[pair.right] = cost;
        reached_by_[pair.right] = i;
        if (const auto owner = left_of_[pair.right]) to_left[*owner] = cost - pair_cost[*owner];
        changed = true;
      }
    }
    return to_right;
  }

  const std::vector<CandidatePair>& candidates_;
  std::vector<std::optional<std::size_t>> right_of_, left_of_;
  std::vector<std::size_t> reached_by_;  ///< by right item: the candidate that its path ends with
};

}  // namespace

std::vector<std::optional<std::size_t>> assign(std::size_t lefts, std::size_t rights,
                                               const std::vector<CandidatePair>& candidates) {
  Matching matching(lefts, rights, candidates);
  while (matching.augment()) {
  }
  return matching.pairs();
}

}  // namespace hallway::eval
