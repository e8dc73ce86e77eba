// SPDX-License-Identifier: MIT
#include "eval/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/random.hpp"

namespace hallway::eval {
namespace {

struct Sum {
  std::size_t pairs = 0;
  double cost = 0.0;
};

/// The best of all assignments of the left items from `left` on.
Sum best_of_all(std::size_t left, std::size_t lefts, std::vector<bool>& taken,
                const std::vector<CandidatePair>& candidates) {
  if (left == lefts) return {};
  Sum best = best_of_all(left + 1, lefts, taken, candidates);
  for (const CandidatePair& pair : candidates) {
    if (pair.left != left || taken[pair.right]) continue;
    taken[pair.right] = true;
    Sum with = best_of_all(left + 1, lefts, taken, candidates);
    taken[pair.right] = false;
    ++with.pairs;
    with.cost += pair.cost;
    if (with.pairs > best.pairs || (with.pairs == best.pairs && with.cost < best.cost)) best = with;
  }
  return best;
}

TEST(Assignment, AgreesWithTryingAll) {
  const Random random(7, stream_id("assignment"));
  for (std::uint32_t round = 0; round < 200; ++round) {
    std::uint64_t drawn = 0;
    const auto draw = [&] { return random.uniform(round, drawn++); };
    const auto lefts = static_cast<std::size_t>(1 + draw() * 6);
    const auto rights = static_cast<std::size_t>(1 + draw() * 6);
    std::vector<CandidatePair> candidates;
    for (std::size_t i = 0; i < lefts; ++i) {
      for (std::size_t k = 0; k < rights; ++k) {
        if (draw() < 0.5) candidates.push_back({i, k, draw()});
      }
    }
    const auto assigned = assign(lefts, rights, candidates);
    Sum sum;
    std::vector<bool> used(rights, false);
    for (std::size_t i = 0; i < lefts; ++i) {
      if (!assigned[i]) continue;
      EXPECT_FALSE(used[*assigned[i]]);
      used[*assigned[i]] = true;
      const auto pair = std::ranges::find_if(
          candidates, [&](const CandidatePair& c) { return c.left == i && c.right == *assigned[i]; });
      ASSERT_NE(pair, candidates.end());
      ++sum.pairs;
      sum.cost += pair->cost;
    }
    std::vector<bool> taken(rights, false);
    const Sum best = best_of_all(0, lefts, taken, candidates);
    EXPECT_EQ(sum.pairs, best.pairs);
    EXPECT_NEAR(sum.cost, best.cost, 1e-9);
  }
}

TEST(Assignment, ShiftedRowIsAssignedWhole) {
  // The nearest pair first would leave one out: 0.3 is nearer to 0.5 than to 0.
  const auto assigned = assign(2, 2, {{0, 0, 0.3}, {0, 1, 0.2}, {1, 1, 0.3}});
  EXPECT_EQ(assigned[0], 0u);
  EXPECT_EQ(assigned[1], 1u);
}

}  // namespace
}  // namespace hallway::eval
