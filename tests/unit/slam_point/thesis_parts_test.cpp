// SPDX-License-Identifier: MIT
// The parts of the thesis's algorithm: histories, bases, groups, who joins a group.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"
#include "slam_point/core/thesis/basis.hpp"
#include "slam_point/core/thesis/group.hpp"
#include "slam_point/core/thesis/history.hpp"
#include "slam_point/core/thesis/selection.hpp"

namespace hallway::slam_point::thesis {
namespace {

Vec3 any_place(scenes::Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

Pose any_pose(scenes::Random& random) {
  return {rotation_exp(any_place(random, 1.5)), any_place(random, 10.0)};
}

std::vector<Vec3> seen_from(const Pose& T_map_sensor, const std::vector<Vec3>& places) {
  std::vector<Vec3> seen;
  for (const Vec3& place : places) seen.push_back(T_map_sensor.inverse() * place);
  return seen;
}

TEST(ThesisHistory, AnswersAsAMapOfAllKeptObservationsWould) {
  scenes::Random random(3);
  History history;
  std::map<Iteration, double> oracle;
  for (Iteration now = 0; now < 2000; ++now) {
    if (random.uniform(0, 1) < 0.6) {
      const double x = random.uniform(-1, 1);
      history.add(now, Vec3(x, 0, 0));
      oracle[now] = x;
    }
    const Iteration oldest = now > 100 ? now - 100 : 0;
    history.forget_before(oldest);
    oracle.erase(oracle.begin(), oracle.lower_bound(oldest));
    const auto first = static_cast<Iteration>(random.uniform(0, now + 10));
    const auto last = first + static_cast<Iteration>(random.uniform(0, 80));
    ASSERT_EQ(history.count(first, last),
              static_cast<std::size_t>(std::distance(oracle.lower_bound(first), oracle.upper_bound(last))));
    ASSERT_EQ(history.find(first) != nullptr, oracle.count(first) == 1);
    if (oracle.count(first) == 1) {
      ASSERT_EQ(history.find(first)->x(), oracle[first]);
    }
  }
}

TEST(ThesisHistory, TakesInAnothersObservationsWhereItHasNone) {
  History older;
  older.add(1, Vec3(1, 0, 0));
  older.add(5, Vec3(5, 0, 0));
  History newer;
  newer.add(3, Vec3(3, 0, 0));
  newer.add(5, Vec3(-5, 0, 0));
  newer.add(9, Vec3(9, 0, 0));
  older.merge(newer);
  std::vector<double> x;
  for (const Sighting& sighting : older.between(0, 100)) x.push_back(sighting.point.x());
  EXPECT_EQ(x, (std::vector<double>{1, 3, 5, 9}));
}

TEST(ThesisBasis, IsTheLongestLineAndWhatIsFarthestFromIt) {
  const std::vector<Vec3> points{{1, 1, 0}, {0, 0, 0}, {5, 0.5, 0}, {10, 0, 0}, {6, -3, 0}};
  BasisPoints basis{};
  ASSERT_TRUE(choose_basis(points, 0.1, basis));
  EXPECT_EQ(basis, (BasisPoints{1, 3, 4}));
}

TEST(ThesisBasis, APointTooNearToTheLineOrTooFewPointsMakeNone) {
  const std::vector<Vec3> line{{0, 0, 0}, {1, 0.05, 0}, {2, 0, 0}};
  BasisPoints basis{};
  EXPECT_FALSE(choose_basis(line, 0.1, basis));
  EXPECT_TRUE(choose_basis(line, 0.04, basis));
  EXPECT_FALSE(choose_basis(std::vector<Vec3>{{0, 0, 0}, {1, 1, 0}}, 0.0, basis));
  EXPECT_FALSE(choose_basis(std::vector<Vec3>(4, Vec3(1, 1, 1)), 0.0, basis));
}

TEST(ThesisBasis, PutsItsPointsWhereTheThesisHasThem) {
  scenes::Random random(4);
  for (int i = 0; i < 50; ++i) {
    const Vec3 a = any_place(random, 9);
    const Vec3 b = any_place(random, 9);
    const Vec3 c = any_place(random, 9);
    const Pose T = basis_pose(a, b, c);
    EXPECT_NEAR((T * a).norm(), 0.0, 1e-12);
    EXPECT_NEAR((T * b - Vec3(-(a - b).norm(), 0, 0)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((T * c).z(), 0.0, 1e-12);
    EXPECT_GT((T * c).y(), 0.0);
  }
}

TEST(ThesisBasis, MakesPlacesIndependentOfTheViewpoint) {
  scenes::Random random(5);
  std::vector<Vec3> places;
  for (int i = 0; i < 6; ++i) places.push_back(any_place(random, 9));
  const std::vector<Vec3> here = seen_from(any_pose(random), places);
  const std::vector<Vec3> there = seen_from(any_pose(random), places);
  const Pose T_here = basis_pose(here[0], here[1], here[2]);
  const Pose T_there = basis_pose(there[0], there[1], there[2]);
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_NEAR((T_here * here[i] - T_there * there[i]).norm(), 0.0, 1e-12);
}

TEST(ThesisRigidFit, FindsAnyMotionFromNothing) {
  scenes::Random random(6);
  for (const double height : {9.0, 0.0}) {  // in space, and all on a plane
    for (int i = 0; i < 50; ++i) {
      const Pose truth{rotation_exp(any_place(random, 3.0)), any_place(random, 10.0)};
      std::vector<Vec3> b;
      for (int p = 0; p < 5; ++p) b.push_back(any_place(random, 9.0).cwiseProduct(Vec3(1, 1, height / 9.0)));
      std::vector<Vec3> a;
      for (const Vec3& p : b) a.push_back(truth * p);
      Pose found;
      ASSERT_TRUE(rigid_fit(a, b, found));
      EXPECT_NEAR(rotation_log(found.q.conjugate() * truth.q).norm(), 0.0, 1e-7);
      EXPECT_NEAR((found.t - truth.t).norm(), 0.0, 1e-7);
    }
  }
}

TEST(ThesisRigidFit, ALineDeterminesNothing) {
  const std::vector<Vec3> line{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {7, 7, 7}};
  Pose T;
  EXPECT_FALSE(rigid_fit(line, line, T));
  EXPECT_FALSE(rigid_fit(std::vector<Vec3>(line.begin(), line.begin() + 2),
                         std::vector<Vec3>(line.begin(), line.begin() + 2), T));
}

class ThesisGroup : public testing::TestWithParam<Basis> {};

TEST_P(ThesisGroup, LiesInTheMapByItsReferencesAndMapsTheRest) {
  scenes::Random random(7);
  std::vector<Vec3> places;
  std::vector<Index> members;
  for (Index i = 0; i < 8; ++i) {
    places.push_back(any_place(random, 9));
    members.push_back(10 + i);
  }
  Group group(members, 4, 2);
  for (int i = 0; i < 10; ++i) {
    // Turns of about 0.1 rad an iteration, as a sensor makes them.
    const Pose T{rotation_exp(Vec3(0.02 * i, 0.0, 0.1 * i)), Vec3(0.3 * i, 0, 0)};
    ASSERT_TRUE(group.add(seen_from(T, places), GetParam(), 0.1));
  }
  ASSERT_TRUE(group.place(std::vector<Vec3>(places.begin(), places.begin() + 4)));
  EXPECT_EQ(group.iterations(), 10u);
  for (std::size_t m = 0; m < places.size(); ++m)
    EXPECT_NEAR((group.position(m) - places[m]).norm(), 0.0, 1e-9);
}

TEST_P(ThesisGroup, MoreIterationsAverageTheNoiseOut) {
  scenes::Random random(8);
  std::vector<Vec3> places;
  std::vector<Index> members;
  for (Index i = 0; i < 8; ++i) {
    places.push_back(any_place(random, 9));
    members.push_back(i);
  }
  const auto error_after = [&](int iterations) {
    Group group(members, members.size(), 2);
    for (int i = 0; i < iterations; ++i) {
      std::vector<Vec3> seen = seen_from({rotation_exp(Vec3(0, 0, 0.01 * i)), Vec3(0.1 * i, 0, 0)}, places);
      for (Vec3& p : seen) p += 0.05 * Vec3(random.normal(), random.normal(), random.normal());
      EXPECT_TRUE(group.add(seen, GetParam(), 0.1));
    }
    EXPECT_TRUE(group.place(places));
    double sum = 0.0;
    for (std::size_t m = 0; m < places.size(); ++m) sum += (group.position(m) - places[m]).squaredNorm();
    return std::sqrt(sum / static_cast<double>(places.size()));
  };
  EXPECT_LT(error_after(400), 0.4 * error_after(4));
}

TEST_P(ThesisGroup, PointsOnALineHaveNoBasis) {
  Group group({0, 1, 2}, 3, 1);
  EXPECT_FALSE(group.add(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0.001, 0}}, GetParam(), 0.1));
  EXPECT_EQ(group.iterations(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Bases, ThesisGroup, testing::Values(Basis::three, Basis::all));

TEST(ThesisSelection, ConstantsChooseTheMappedOnesSeenMostAndAllOthersSeenEnough) {
  Constants constants;
  constants.threshold = 50;
  constants.previous_min = 2;
  constants.previous_max = 3;
  constants.next_min = 1;
  const std::vector<Candidate> previous{{1, 51}, {2, 60}, {3, 49}, {4, 55}, {5, 53}};
  const std::vector<Candidate> next{{6, 10}, {7, 61}, {8, 50}};
  Selection selection;
  ASSERT_TRUE(select_by_constants(previous, next, constants, false, selection));
  EXPECT_EQ(selection.points, (std::vector<Index>{2, 4, 5, 7, 8}));
  EXPECT_EQ(selection.previous, 3u);
}

TEST(ThesisSelection, TooFewOfEitherMakeNoGroupByConstants) {
  Constants constants;
  constants.threshold = 50;
  constants.previous_min = 3;
  constants.previous_max = 20;
  constants.next_min = 2;
  Selection selection;
  EXPECT_FALSE(select_by_constants({{1, 60}, {2, 60}}, {{6, 60}, {7, 60}}, constants, false, selection));
  EXPECT_FALSE(
      select_by_constants({{1, 60}, {2, 60}, {3, 60}}, {{6, 60}, {7, 49}}, constants, false, selection));
  EXPECT_TRUE(
      select_by_constants({{1, 60}, {2, 60}, {3, 60}}, {{6, 60}, {7, 50}}, constants, false, selection));
}

TEST(ThesisSelection, TheFirstGroupNeedsNoMappedPoint) {
  Constants constants;
  constants.threshold = 50;
  constants.previous_min = 3;
  constants.next_min = 1;
  Selection selection;
  EXPECT_TRUE(select_by_constants({}, {{6, 60}, {7, 60}, {8, 60}}, constants, true, selection));
  EXPECT_EQ(selection.previous, 0u);
  EXPECT_FALSE(select_by_constants({}, {{6, 60}, {7, 60}}, constants, true, selection)) << "two points";
}

TEST(ThesisSelection, AmongPointsSeenAsOftenTheOldestAreNotPreferred) {
  std::vector<Candidate> candidates;
  for (Index i = 0; i < 100; ++i) candidates.push_back({i, 60});
  sort_most_seen_first(candidates);
  double mean = 0.0;
  for (std::size_t i = 0; i < 20; ++i) mean += candidates[i].point / 20.0;
  EXPECT_GT(mean, 30.0);
  EXPECT_LT(mean, 70.0);
}

PresentPoint present(Index point, std::size_t first, std::size_t last) {
  Presence presence(100);
  for (std::size_t i = first; i <= last; ++i) presence.set(i);
  return {point, presence};
}

TEST(ThesisSelection, WithoutConstantsMembersJoinWhileTheTotalGrows) {
  // Three mapped ones over all 100 iterations: 100 x 4. One over 90: 90 x 5 is more. One over 10: 10 x 6 is less. Unmapped ones: 80 of
  // those 90 give 80 x 6, which is more, 20 give 20 x 7, less.
  Selection selection;
  ASSERT_TRUE(select_by_total(
      present(0, 0, 99),
      {present(1, 0, 99), present(2, 0, 99), present(3, 0, 99), present(4, 10, 99), present(5, 0, 9)},
      {present(6, 20, 99), present(7, 40, 59)}, false, selection));
  EXPECT_EQ(selection.previous, 4u);
  const std::set<Index> mapped(selection.points.begin(), selection.points.begin() + 4);
  EXPECT_EQ(mapped, (std::set<Index>{1, 2, 3, 4}));
  EXPECT_EQ(std::vector<Index>(selection.points.begin() + 4, selection.points.end()),
            (std::vector<Index>{0, 6}));
}

/// Slow and obvious: of those left, the one seen most joins, or is passed over, one after the other.
Selection by_total_of_sets(const std::vector<std::set<std::size_t>>& seen, std::size_t creation,
                           std::size_t mapped, const std::vector<Index>& order) {
  std::set<std::size_t> together = seen[creation];
  Selection selection;
  std::vector<Index> unmapped{static_cast<Index>(creation)};
  const auto with = [&](Index point) {
    std::set<std::size_t> both;
    for (const std::size_t i : together) {
      if (seen[point].contains(i)) both.insert(i);
    }
    return both;
  };
  for (std::size_t o = 0; o < order.size(); ++o) {
    const std::size_t members = selection.points.size() + unmapped.size();
    const std::set<std::size_t> both = with(order[o]);
    if (o >= 3 && both.size() * (members + 1) <= together.size() * members) continue;
    together = both;
    (order[o] < mapped ? selection.points : unmapped).push_back(order[o]);
  }
  selection.previous = selection.points.size();
  selection.points.insert(selection.points.end(), unmapped.begin(), unmapped.end());
  return selection;
}

TEST(ThesisSelection, WithoutConstantsIsWhatCountingSetsGives) {
  constexpr std::size_t kMapped = 12;
  constexpr std::size_t kPoints = 25;  // the last one is what the group is for
  int groups = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    scenes::Random random(seed);
    std::vector<std::set<std::size_t>> seen(kPoints);
    std::vector<PresentPoint> points;
    for (Index p = 0; p < kPoints; ++p) {
      Presence presence(100);
      const double first = random.uniform(0, 70);
      const double last = random.uniform(first, 130);
      for (std::size_t i = 0; i < 100; ++i) {
        const auto at = static_cast<double>(i);
        if (p + 1 < kPoints && (at < first || at > last || random.uniform(0, 1) < 0.1)) continue;
        presence.set(i);
        seen[p].insert(i);
      }
      points.push_back({p, presence});
    }
    // Mapped ones first, those seen most first; the order of equal ones is that of sort_most_seen_first().
    std::vector<Index> order;
    for (const bool mapped : {true, false}) {
      std::vector<Candidate> candidates;
      for (Index p = 0; p + 1 < kPoints; ++p) {
        if ((p < kMapped) == mapped) candidates.push_back({p, seen[p].size()});
      }
      sort_most_seen_first(candidates);
      for (std::size_t c = 1; c < candidates.size(); ++c)
        EXPECT_GE(candidates[c - 1].count, candidates[c].count);
      for (const Candidate& candidate : candidates) order.push_back(candidate.point);
    }
    Selection selection;
    if (!select_by_total(points.back(), {points.begin(), points.begin() + kMapped},
                         {points.begin() + kMapped, points.end() - 1}, false, selection))
      continue;
    ++groups;
    const Selection expected = by_total_of_sets(seen, kPoints - 1, kMapped, order);
    EXPECT_EQ(selection.points, expected.points) << seed;
    EXPECT_EQ(selection.previous, expected.previous) << seed;
  }
  EXPECT_GT(groups, 50);
}

TEST(ThesisSelection, IsTheSameInWhateverOrderPointsAreGiven) {
  scenes::Random random(10);
  std::vector<Candidate> previous;
  std::vector<Candidate> next;
  std::vector<PresentPoint> mapped;
  std::vector<PresentPoint> unmapped;
  for (Index p = 0; p < 40; ++p) {
    const auto count = static_cast<std::size_t>(random.uniform(45, 60));
    (p % 2 == 0 ? previous : next).push_back({p, count});
    (p % 2 == 0 ? mapped : unmapped).push_back(present(p, 0, count));
  }
  const Constants constants{50, 3, 8, 1};
  Selection by_constants;
  Selection by_total;
  ASSERT_TRUE(select_by_constants(previous, next, constants, false, by_constants));
  ASSERT_TRUE(select_by_total(present(99, 0, 99), mapped, unmapped, false, by_total));
  std::reverse(previous.begin(), previous.end());
  std::rotate(next.begin(), next.begin() + 7, next.end());
  std::reverse(mapped.begin(), mapped.end());
  std::rotate(unmapped.begin(), unmapped.begin() + 7, unmapped.end());
  Selection again;
  ASSERT_TRUE(select_by_constants(previous, next, constants, false, again));
  EXPECT_EQ(again.points, by_constants.points);
  ASSERT_TRUE(select_by_total(present(99, 0, 99), mapped, unmapped, false, again));
  EXPECT_EQ(again.points, by_total.points);
}

TEST(ThesisSelection, WithoutConstantsThreeMappedOnesAreNeeded) {
  Selection selection;
  EXPECT_FALSE(select_by_total(present(0, 0, 99), {present(1, 0, 99), present(2, 0, 99)}, {present(3, 0, 99)},
                               false, selection));
  EXPECT_FALSE(select_by_total(present(0, 0, 49), {present(1, 50, 99), present(2, 0, 99), present(3, 0, 99)},
                               {}, false, selection))
      << "never all together";
  EXPECT_TRUE(select_by_total(present(0, 0, 99), {},
                              {present(1, 0, 99), present(2, 0, 99), present(3, 0, 99)}, true, selection));
}

TEST(ThesisSelection, PresenceCountsAsABitmapWould) {
  scenes::Random random(9);
  Presence a(130);
  Presence b(130);
  std::set<std::size_t> in_a;
  std::set<std::size_t> in_both;
  for (std::size_t i = 0; i < 130; ++i) {
    const bool is_in_a = random.uniform(0, 1) < 0.5;
    const bool is_in_b = random.uniform(0, 1) < 0.5;
    if (is_in_a) a.set(i);
    if (is_in_b) b.set(i);
    if (is_in_a) in_a.insert(i);
    if (is_in_a && is_in_b) in_both.insert(i);
  }
  EXPECT_EQ(a.count(), in_a.size());
  EXPECT_EQ(a.count_with(b), in_both.size());
  a.keep(b);
  EXPECT_EQ(a.count(), in_both.size());
}

}  // namespace
}  // namespace hallway::slam_point::thesis
