// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/pair_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/random.hpp"

namespace hallway::slam_plane::thesis::test {
namespace {

using Matrix = std::vector<std::vector<double>>;

/// Sum of a greatest spanning tree, by Prim's algorithm on the complete graph.
double prim(const Matrix& weights) {
  const std::size_t n = weights.size();
  std::vector<double> best(weights[0]);
  std::vector<bool> in(n, false);
  in[0] = true;
  double total = 0.0;
  for (std::size_t i = 1; i < n; ++i) {
    std::size_t next = 0;
    for (std::size_t j = 1; j < n; ++j) {
      if (!in[j] && (next == 0 || best[j] > best[next])) next = j;
    }
    in[next] = true;
    total += best[next];
    for (std::size_t j = 1; j < n; ++j) best[j] = std::max(best[j], weights[next][j]);
  }
  return total;
}

Comparison comparison_over(int shared, bool parallel, KeyPoint parent, KeyPoint child) {
  Comparison comparison;
  comparison.valid = true;
  comparison.shared = shared;
  comparison.parallel = parallel;
  comparison.size[0] = comparison.size[1] = 1.0;
  comparison.key[0] = parent;
  comparison.key[1] = child;
  return comparison;
}

/// Comparisons of members, and what they offer.
struct Offered {
  std::vector<PlaceStep> steps;
  std::vector<Comparison> comparisons;  // child relative to parent, of each
  std::vector<PlaceOffer> offers;       // sorted

  void add(std::size_t parent, std::size_t child, const Comparison& comparison) {
    steps.push_back({parent, child, {comparison.key[0], comparison.key[1]}});
    comparisons.push_back(comparison);
    offers.push_back({steps.back(), worth(comparison)});
    sort_offers(offers);
  }

  std::vector<PlaceStep> order(std::size_t root, std::size_t members) const {
    return OfferGraph(offers, members).spanning_steps(root);
  }

  /// The members as a submap places them, in the order of steps.
  std::vector<Reference> placed(const std::vector<PlaceStep>& order, std::size_t members) const {
    std::vector<Reference> references(members);
    for (const PlaceStep& step : order) {
      const Comparison& comparison = of(step);
      if (&step == &order.front()) references[step.parent] = reference_of(comparison, 0);
      take_offer(references[step.parent], comparison, references[step.child]);
    }
    return references;
  }

  const Comparison& of(const PlaceStep& step) const {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (steps[i] == step) return comparisons[i];
    }
    throw std::logic_error("no comparison for a step");
  }
};

/// Comparisons of all pairs, over as many iterations as the matrix says.
Offered offered_by(const Matrix& shared, const Matrix& parallel) {
  Offered offered;
  for (std::size_t a = 0; a < shared.size(); ++a) {
    for (std::size_t b = 0; b < shared.size(); ++b) {
      if (a == b || shared[a][b] <= 0.0) continue;
      const Comparison comparison = comparison_over(static_cast<int>(shared[a][b]), parallel[a][b] > 0.0,
                                                    KeyPoint::left, KeyPoint::left);
      const PlaceStep step{a, b, {KeyPoint::left, KeyPoint::left}};
      offered.steps.push_back(step);
      offered.comparisons.push_back(comparison);
      offered.offers.push_back({step, worth(comparison)});
    }
  }
  sort_offers(offered.offers);
  return offered;
}

Matrix random_matrix(const Random& random, std::uint32_t draw, std::size_t n, double least, double most) {
  Matrix matrix(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j)
      matrix[i][j] = matrix[j][i] = std::floor(random.uniform(draw, 100 * i + j, least, most));
  }
  return matrix;
}

double total_of(const std::vector<PlaceStep>& steps, const Matrix& shared) {
  double total = 0.0;
  for (const PlaceStep& step : steps) total += shared[step.parent][step.child];
  return total;
}

TEST(PairOrder, TotalIntervalIsThatOfPrimsTreeOfAllPairs) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Random random(seed, stream_id("pair_order_test"));
    const std::size_t n = 2 + static_cast<std::size_t>(random.uniform(0, 0, 0.0, 30.0));
    const Matrix shared = random_matrix(random, 1, n, 1.0, 400.0);
    const Matrix parallel = random_matrix(random, 2, n, 0.0, seed % 2 == 0 ? 1.0 : 2.0);
    const Offered offered = offered_by(shared, parallel);
    const std::size_t root = offered.offers.front().step.parent;
    const std::vector<PlaceStep> steps = offered.order(root, n);
    ASSERT_EQ(steps.size(), n - 1);
    EXPECT_GE(total_of(steps, shared), (seed % 2 == 0 ? 1.0 : 0.95) * prim(shared));
    for (const Reference& reference : offered.placed(steps, n)) EXPECT_TRUE(reference.valid());
  }
}

TEST(PairOrder, PairsThatAreNotParallelArePreferred) {
  // 2 was seen with 0, which is parallel to it, as long as with 1.
  const Matrix shared{{0, 120, 100}, {120, 0, 100}, {100, 100, 0}};
  const Matrix parallel{{0, 0, 1}, {0, 0, 0}, {1, 0, 0}};
  const std::vector<PlaceStep> steps = offered_by(shared, parallel).order(0, 3);
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[1].parent, 1u);
  EXPECT_EQ(steps[1].child, 2u);
}

TEST(PairOrder, MembersThatNothingConnectsAreLeftOut) {
  const Matrix shared{{0, 10, 0, 0}, {10, 0, 0, 0}, {0, 0, 0, 10}, {0, 0, 10, 0}};
  const Offered offered = offered_by(shared, Matrix(4, std::vector<double>(4, 0.0)));
  EXPECT_EQ(offered.order(0, 4).size(), 1u);
  EXPECT_EQ(OfferGraph(offered.offers, 4).placed_from(0), (std::vector<bool>{true, true, false, false}));
}

TEST(PairOrder, EndsThatNothingHasInCommonPlaceNothingUntilTheyAreKnown) {
  // 1 is placed by its left end, and 2 lies at its right one: that has to be told first.
  Offered offered;
  offered.add(1, 2, comparison_over(90, false, KeyPoint::right, KeyPoint::left));
  offered.add(0, 1, comparison_over(50, false, KeyPoint::left, KeyPoint::left));
  const std::vector<Reference> without = offered.placed(offered.order(0, 3), 3);
  EXPECT_TRUE(without[1].valid());
  EXPECT_FALSE(without[2].valid());
  offered.add(0, 1, comparison_over(20, false, KeyPoint::left, KeyPoint::right));
  const std::vector<PlaceStep> steps = offered.order(0, 3);
  EXPECT_EQ(steps.size(), 3u);
  const std::vector<Reference> with = offered.placed(steps, 3);
  EXPECT_TRUE(with[1].full());
  EXPECT_TRUE(with[2].valid());
}

/// The order by its definition, placing as it goes: always the first offer that tells anything.
std::vector<PlaceStep> first_that_tells(std::size_t root, const Offered& offered,
                                        std::vector<Reference>& references) {
  std::vector<PlaceStep> steps;
  for (std::size_t i = 0; i < offered.offers.size();) {
    const PlaceStep& step = offered.offers[i].step;
    const Comparison& comparison = offered.of(step);
    if (steps.empty() && step.parent == root) references[root] = reference_of(comparison, 0);
    const bool told = take_offer(references[step.parent], comparison, references[step.child]);
    if (told) steps.push_back(step);
    i = told ? 0 : i + 1;
  }
  return steps;
}

/// Some comparisons between ends that chance chooses, both ways round.
Offered offered_by_chance(std::size_t members, std::uint32_t draw) {
  const Random random(7, stream_id("pair_order_test"));
  Offered offered;
  std::uint64_t n = 0;
  const auto chance = [&](double most) { return random.uniform(draw, n++, 0.0, most); };
  const auto key = [&] { return chance(1.0) < 0.5 ? KeyPoint::left : KeyPoint::right; };
  for (std::size_t a = 0; a < members; ++a) {
    for (std::size_t b = a + 1; b < members; ++b) {
      if (chance(1.0) < 0.4) continue;
      Comparison there = comparison_over(static_cast<int>(chance(12.0)) + 1, chance(1.0) < 0.3, key(),
                                         chance(1.0) < 0.2 ? KeyPoint::none : key());
      there.offset = Vec2(chance(4.0), chance(4.0));
      std::vector<PlaceOffer> both;
      append_offers({a, b, {there.key[0], there.key[1]}}, worth(there), both);
      EXPECT_EQ(both.size(), there.has_keys() ? 2u : 1u);
      offered.add(a, b, there);
      if (inverse(there).places()) offered.add(b, a, inverse(there));
    }
  }
  return offered;
}

TEST(PairOrder, TheNextStepIsAlwaysTheFirstOfferThatTellsAnything) {
  for (std::uint32_t draw = 0; draw < 200; ++draw) {
    const std::size_t members = 2 + draw % 8;
    const Offered offered = offered_by_chance(members, draw);
    for (std::size_t root = 0; root < members; ++root) {
      std::vector<Reference> expected(members);
      const std::vector<PlaceStep> by_definition = first_that_tells(root, offered, expected);
      const std::vector<PlaceStep> steps = offered.order(root, members);
      ASSERT_EQ(steps, by_definition);
      const std::vector<Reference> found = offered.placed(steps, members);
      OfferGraph graph(offered.offers, members);
      const std::vector<bool>& placed = graph.placed_from(root);
      for (std::size_t i = 0; i < members; ++i) {
        EXPECT_EQ(placed[i], expected[i].valid());
        EXPECT_EQ(found[i].valid(), expected[i].valid());
        EXPECT_EQ(found[i].place.middle, expected[i].place.middle);
      }
    }
  }
}

TEST(PairOrder, ALineIsTakenOnlyWhereNothingElsePlacesAMember) {
  Offered offered;
  offered.add(0, 1, comparison_over(500, false, KeyPoint::left, KeyPoint::none));
  offered.add(0, 1, comparison_over(5, false, KeyPoint::left, KeyPoint::left));
  offered.add(0, 2, comparison_over(40, false, KeyPoint::left, KeyPoint::none));
  const std::vector<PlaceStep> steps = offered.order(0, 3);
  EXPECT_EQ(steps.size(), 2u);
  const std::vector<Reference> references = offered.placed(steps, 3);
  EXPECT_TRUE(references[1].known[kEndA]);
  EXPECT_TRUE(references[2].valid());
  EXPECT_FALSE(references[2].known[kEndA] || references[2].known[kEndB]);
}

}  // namespace
}  // namespace hallway::slam_plane::thesis::test
