// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/pair_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

/// Comparisons of all pairs, over as many iterations as the matrix says.
std::vector<PlaceOffer> offers_of(const Matrix& shared, const Matrix& parallel) {
  std::vector<PlaceOffer> offers;
  for (std::size_t a = 0; a < shared.size(); ++a) {
    for (std::size_t b = 0; b < shared.size(); ++b) {
      if (a == b || shared[a][b] <= 0.0) continue;
      const Comparison comparison = comparison_over(static_cast<int>(shared[a][b]), parallel[a][b] > 0.0,
                                                    KeyPoint::left, KeyPoint::left);
      offers.push_back({{a, b, {KeyPoint::left, KeyPoint::left}}, comparison});
    }
  }
  sort_offers(offers);
  return offers;
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
    const std::vector<PlaceOffer> offers = offers_of(shared, parallel);
    std::vector<Reference> references(n);
    const std::size_t root = offers.front().step.parent;
    const std::vector<PlaceStep> steps = spanning_steps(root, offers, references);
    ASSERT_EQ(steps.size(), n - 1);
    EXPECT_GE(total_of(steps, shared), (seed % 2 == 0 ? 1.0 : 0.95) * prim(shared));
    for (const Reference& reference : references) EXPECT_TRUE(reference.valid());
  }
}

TEST(PairOrder, PairsThatAreNotParallelArePreferred) {
  // 2 was seen with 0, which is parallel to it, as long as with 1.
  const Matrix shared{{0, 120, 100}, {120, 0, 100}, {100, 100, 0}};
  const Matrix parallel{{0, 0, 1}, {0, 0, 0}, {1, 0, 0}};
  std::vector<Reference> references(3);
  const std::vector<PlaceStep> steps = spanning_steps(0, offers_of(shared, parallel), references);
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[1].parent, 1u);
  EXPECT_EQ(steps[1].child, 2u);
}

TEST(PairOrder, MembersThatNothingConnectsAreLeftOut) {
  const Matrix shared{{0, 10, 0, 0}, {10, 0, 0, 0}, {0, 0, 0, 10}, {0, 0, 10, 0}};
  std::vector<Reference> references(4);
  EXPECT_EQ(spanning_steps(0, offers_of(shared, Matrix(4, std::vector<double>(4, 0.0))), references).size(),
            1u);
  EXPECT_TRUE(references[1].valid());
  EXPECT_FALSE(references[2].valid());
}

TEST(PairOrder, EndsThatNothingHasInCommonPlaceNothingUntilTheyAreKnown) {
  // 1 is placed by its left end, and 2 lies at its right one: that has to be told first.
  std::vector<PlaceOffer> offers{
      {{1, 2, {KeyPoint::right, KeyPoint::left}},
       comparison_over(90, false, KeyPoint::right, KeyPoint::left)},
      {{0, 1, {KeyPoint::left, KeyPoint::left}}, comparison_over(50, false, KeyPoint::left, KeyPoint::left)}};
  std::vector<Reference> without(3), with(3);
  spanning_steps(0, offers, without);
  EXPECT_TRUE(without[1].valid());
  EXPECT_FALSE(without[2].valid());
  offers.push_back({{0, 1, {KeyPoint::left, KeyPoint::right}},
                    comparison_over(20, false, KeyPoint::left, KeyPoint::right)});
  EXPECT_EQ(spanning_steps(0, offers, with).size(), 3u);
  EXPECT_TRUE(with[1].full());
  EXPECT_TRUE(with[2].valid());
}

/// The order by its definition: always the first offer that tells anything.
std::vector<PlaceStep> first_that_tells(std::size_t root, const std::vector<PlaceOffer>& offers,
                                        std::vector<Reference>& references) {
  std::vector<PlaceStep> steps;
  for (std::size_t i = 0; i < offers.size();) {
    const PlaceStep& step = offers[i].step;
    if (steps.empty() && step.parent == root) references[root] = reference_of(offers[i].comparison, 0);
    const bool told = take_offer(references[step.parent], offers[i].comparison, references[step.child]);
    if (told) steps.push_back(step);
    i = told ? 0 : i + 1;
  }
  return steps;
}

/// Some comparisons between ends that chance chooses, both ways round.
std::vector<PlaceOffer> offers_by_chance(std::size_t members, std::uint32_t draw) {
  const Random random(7, stream_id("pair_order_test"));
  std::vector<PlaceOffer> offers;
  std::uint64_t n = 0;
  const auto chance = [&](double most) { return random.uniform(draw, n++, 0.0, most); };
  const auto key = [&] { return chance(1.0) < 0.5 ? KeyPoint::left : KeyPoint::right; };
  for (std::size_t a = 0; a < members; ++a) {
    for (std::size_t b = a + 1; b < members; ++b) {
      if (chance(1.0) < 0.4) continue;
      Comparison there = comparison_over(static_cast<int>(chance(12.0)) + 1, chance(1.0) < 0.3, key(),
                                         chance(1.0) < 0.2 ? KeyPoint::none : key());
      there.offset = Vec2(chance(4.0), chance(4.0));
      offers.push_back({{a, b, {there.key[0], there.key[1]}}, there});
      const Comparison back = inverse(there);
      if (back.places()) offers.push_back({{b, a, {back.key[0], back.key[1]}}, back});
    }
  }
  sort_offers(offers);
  return offers;
}

TEST(PairOrder, TheNextStepIsAlwaysTheFirstOfferThatTellsAnything) {
  for (std::uint32_t draw = 0; draw < 200; ++draw) {
    const std::size_t members = 2 + draw % 8;
    const std::vector<PlaceOffer> offers = offers_by_chance(members, draw);
    for (std::size_t root = 0; root < members; ++root) {
      std::vector<Reference> expected(members), found(members);
      const std::vector<PlaceStep> by_definition = first_that_tells(root, offers, expected);
      const std::vector<PlaceStep> steps = spanning_steps(root, offers, found);
      ASSERT_EQ(steps.size(), by_definition.size());
      for (std::size_t i = 0; i < steps.size(); ++i) {
        EXPECT_EQ(steps[i].parent, by_definition[i].parent);
        EXPECT_EQ(steps[i].child, by_definition[i].child);
      }
      OfferGraph graph(offers, members);
      for (std::size_t i = 0; i < members; ++i) {
        EXPECT_EQ(graph.placed_from(root)[i], expected[i].valid());
        EXPECT_EQ(found[i].valid(), expected[i].valid());
        EXPECT_EQ(found[i].place.middle, expected[i].place.middle);
      }
    }
  }
}

TEST(PairOrder, ALineIsTakenOnlyWhereNothingElsePlacesAMember) {
  std::vector<PlaceOffer> offers{
      {{0, 1, {KeyPoint::left, KeyPoint::none}}, comparison_over(500, false, KeyPoint::left, KeyPoint::none)},
      {{0, 1, {KeyPoint::left, KeyPoint::left}}, comparison_over(5, false, KeyPoint::left, KeyPoint::left)},
      {{0, 2, {KeyPoint::left, KeyPoint::none}}, comparison_over(40, false, KeyPoint::left, KeyPoint::none)}};
  sort_offers(offers);
  std::vector<Reference> references(3);
  EXPECT_EQ(spanning_steps(0, offers, references).size(), 2u);
  EXPECT_TRUE(references[1].known[kEndA]);
  EXPECT_TRUE(references[2].valid());
  EXPECT_FALSE(references[2].known[kEndA] || references[2].known[kEndB]);
}

}  // namespace
}  // namespace hallway::slam_plane::thesis::test
