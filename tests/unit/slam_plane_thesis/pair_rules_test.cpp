// SPDX-License-Identifier: MIT
// One test for each rule about matching, tracks and pairs (thesis 4.3). tests/mutation takes each rule away and expects its test, and no other rule's, to fail.
// So each uses as little as possible of what other rules say: the robot drives along x without turning, and of two planes the first one lies along x, unless the rule is about that.
#include <gtest/gtest.h>

#include <algorithm>

#include "slam_plane/thesis/matching.hpp"
#include "slam_plane/thesis/membership.hpp"
#include "slam_plane/thesis/pair_order.hpp"
#include "slam_plane/thesis/resize.hpp"
#include "unit/slam_plane_thesis/walls.hpp"

namespace hallway::slam_plane::thesis::test {
namespace {

constexpr double kExact = 1e-9;

double ramp(Iteration k, Iteration from, Iteration to, double first, double last) {
  const double share = static_cast<double>(k - from) / static_cast<double>(to - from);
  return first + std::clamp(share, 0.0, 1.0) * (last - first);
}

TEST(Rule01, SightingsAreMatchedToTheLatestOnesOfTracksWithoutAPose) {
  Track track(0, TrackOptions{}), other(1, TrackOptions{});
  for (Iteration k = 0; k < 100; ++k) {
    const Pose2 pose =
        Pose2::at(Vec2(0.05 * static_cast<double>(k), 0.0), 0.1 * std::sin(0.3 * static_cast<double>(k)));
    const std::vector<Sighting> now{seen(kAhead, pose, k), seen(kAlong, pose, k)};
    if (k > 0) {
      const std::vector<std::vector<const Track*>> stages{{&track, &other}};
      const auto matched = match_tracks(now, stages, MatchOptions{});
      ASSERT_EQ(matched[0], &other) << k;
      ASSERT_EQ(matched[1], &track) << k;
    }
    other.push(now[0]);
    track.push(now[1]);
  }
}

TEST(Rule02, PlanesAreComparedWithinIterationsAndSoInAnyOrderOfPairs) {
  const Segment behind{{Vec2(-1, 3), Vec2(5, 3)}}, farther{{Vec2(8, 2.5), Vec2(10, 2.5)}};
  Track a(0, TrackOptions{}), b(1, TrackOptions{}), c(2, TrackOptions{});
  for (Iteration k = 0; k < 60; ++k) {
    a.push(seen(kAlong, straight(k), k));
    if (k % 5 != 2) b.push(seen(behind, straight(k), k));
    if (k % 7 != 3) c.push(seen(farther, straight(k), k));
  }
  PairComparer comparer{CompareOptions{}};
  const std::vector<const Track*> members{&a, &b, &c};
  const auto one = place_members(comparer, members, std::vector<PairEdge>{{0, 1}, {1, 2}});
  const auto another = place_members(comparer, members, std::vector<PairEdge>{{0, 2}, {2, 1}});
  for (const auto& placements : {one, another}) {
    ASSERT_TRUE(placements[1].valid && placements[2].valid);
    EXPECT_LT(error_of(placements[1], kAlong, behind), kExact);
    EXPECT_LT(error_of(placements[2], kAlong, farther), kExact);
  }
}

TEST(Rule03, RelativePlaceIsTheSameHoweverTheRobotTurns) {
  for (const auto& [first, second] :
       {std::pair{kAlong, kAhead}, std::pair{kSlanted, kAlong}, std::pair{kAhead, kFacing}}) {
    const Track a = track_of(0, first, {0, 80}, curved), b = track_of(1, second, {0, 80}, curved);
    PairComparer comparer{CompareOptions{}};
    const Comparison comparison = comparer.compare(a, b);
    ASSERT_TRUE(comparison.has_keys());
    EXPECT_LT(error_of(comparison, first, second), kExact);
    EXPECT_LT(comparison.deviation, kExact);
  }
}

TEST(Rule07, MembersWereAllVisibleTogether) {
  const Track a = track_of(0, kAlong, {0, 100}, straight), b = track_of(1, kAhead, {50, 150}, straight);
  const Track late = track_of(2, kSlanted, {120, 150}, straight),
              early = track_of(3, kSlanted, {0, 30}, straight);
  const Track with_both = track_of(4, kSlanted, {40, 90}, straight);
  const std::vector<const Track*> members{&a, &b};
  const Intervals common = common_intervals(members);
  ASSERT_EQ(common, (Intervals{{50, 100}}));
  EXPECT_FALSE(fits(common, late, 10));
  EXPECT_FALSE(fits(common, early, 10));
  EXPECT_TRUE(fits(common, with_both, 10));
}

TEST(Rule09, SubmapsAreLinkedByThePlanesThatCameIntoViewLast) {
  const Track oldest = track_of(0, kAlong, {0, 100}, straight),
              old = track_of(1, kAhead, {20, 100}, straight);
  const Track gone = track_of(2, kFacing, {70, 80}, straight),
              young = track_of(3, kSlanted, {60, 100}, straight);
  const Track newcomer = track_of(4, kSlanted, {90, 100}, straight);
  const std::vector<const Track*> members{&oldest, &old, &gone, &young};
  EXPECT_EQ(linking_members(members, newcomer, 2), (std::vector<int>{3, 1}));
}

TEST(Rule10, TheOtherSideOfAThinWallIsAnotherPlane) {
  Track track(0, TrackOptions{});
  track.push(*make_sighting({Vec2(2, 0.05), Vec2(4, 0.05)}, 0));
  const std::vector<std::vector<const Track*>> stages{{&track}};
  const std::vector<Sighting> same{*make_sighting({Vec2(2, 0.01), Vec2(4, 0.01)}, 1)};
  const std::vector<Sighting> behind{*make_sighting({Vec2(4, -0.01), Vec2(2, -0.01)}, 1)};
  EXPECT_EQ(match_tracks(same, stages, MatchOptions{})[0], &track);
  EXPECT_EQ(match_tracks(behind, stages, MatchOptions{})[0], nullptr);
}

TEST(Rule13, EndsThatStandStillAreFoundByTheLeastDeviation) {
  // All four combinations of the ends at which two planes grow.
  for (int combination = 0; combination < 4; ++combination) {
    const auto hide = [](bool left_is_key) {
      return [left_is_key](Iteration k) {
        const double hidden = ramp(k, 0, 50, 2.0, 0.0);
        return left_is_key ? Hidden{0.0, hidden} : Hidden{hidden, 0.0};
      };
    };
    const bool left_a = combination / 2 == 0, left_b = combination % 2 == 0;
    const Track a = track_of(0, kAlong, {0, 50}, straight, hide(left_a));
    const Track b = track_of(1, kAhead, {0, 50}, straight, hide(left_b));
    PairComparer comparer{CompareOptions{}};
    const Comparison comparison = comparer.compare(a, b);
    ASSERT_TRUE(comparison.has_keys());
    EXPECT_EQ(comparison.key[0], left_a ? KeyPoint::left : KeyPoint::right);
    EXPECT_EQ(comparison.key[1], left_b ? KeyPoint::left : KeyPoint::right);
    EXPECT_LT(error_of(comparison, kAlong, kAhead), kExact);
    EXPECT_LT(comparison.deviation, kExact);
  }
}

TEST(Rule14, EndsAreNumberedAsTheRobotSeesThem) {
  Track a(0, TrackOptions{}), b(1, TrackOptions{});
  for (Iteration k = 0; k < 40; ++k) {
    const Sighting told = seen(kAhead, straight(k), k);
    Piece piece{told.segment.end[0], told.segment.end[1], 0.0, 2.5};
    if (k % 2 == 1) std::swap(piece.a, piece.b);
    b.push(*make_sighting(piece, k));
    a.push(seen(kAlong, straight(k), k));
    EXPECT_GT(b.newest().segment.end[kEndA].y(), b.newest().segment.end[kEndB].y());
    EXPECT_LT(b.newest().segment.normal().x(), 0.0);  // faces the robot
  }
  PairComparer comparer{CompareOptions{}};
  const Comparison comparison = comparer.compare(a, b);
  ASSERT_TRUE(comparison.has_keys());
  EXPECT_LT(error_of(comparison, kAlong, kAhead), kExact);
}

TEST(Rule15, ParallelPlanesThatGrowTogetherHaveNoKeyPointsThoughTheOffsetIsRight) {
  // Two walls on the same side, one behind the other, both cut by the view's far end.
  const Segment behind{{Vec2(-1, 3), Vec2(7, 3)}};
  const auto grow = [](Iteration k) { return Hidden{0.0, ramp(k, 0, 50, 4.0, 1.0)}; };
  const Track a = track_of(0, kAlong, {0, 50}, straight, grow),
              b = track_of(1, behind, {0, 50}, straight, grow);
  PairComparer comparer{CompareOptions{}};
  const Comparison comparison = comparer.compare(a, b);
  ASSERT_TRUE(comparison.valid);
  EXPECT_TRUE(comparison.parallel);
  EXPECT_FALSE(comparison.has_keys());
  EXPECT_LT((comparison.offset - Vec2(1, 1)).norm(), kExact);  // of equal parts
}

TEST(Rule16, WhatIsSeenOfAPlaneGrowsToItsFullSizeFromTheKeyPoint) {
  const auto grown = resized(Segment{{Vec2(1, 2), Vec2(4, 2)}}, KeyPoint::right, 5.0);
  ASSERT_TRUE(grown.has_value());
  EXPECT_LT((grown->end[kEndA] - Vec2(-1, 2)).norm(), kExact);
  EXPECT_LT((grown->end[kEndB] - Vec2(4, 2)).norm(), kExact);
  EXPECT_FALSE(resized(Segment{{Vec2(1, 2), Vec2(4, 2)}}, KeyPoint::none, 5.0).has_value());
}

TEST(Rule17, TheSmallerOneOfTwoViewsOfAPlaneGrowsToTheLargerOne) {
  Placement whole{Vec2(0, 0), Vec2(1, 0), 6.0, KeyPoint::left, {}, true};
  Placement part{Vec2(11, 3), Vec2(0, 1), 2.0, KeyPoint::right, {}, true};
  ASSERT_TRUE(bring_to_one_size(whole, part, 0.0));
  EXPECT_DOUBLE_EQ(whole.size, 6.0);
  EXPECT_DOUBLE_EQ(part.size, 6.0);
  EXPECT_LT((whole.middle - Vec2(0, 0)).norm(), kExact);
  EXPECT_LT((part.middle - Vec2(11, 1)).norm(), kExact);  // its right end stays
}

TEST(Rule18, TimeIsSplitWhereAPlaneTurnsFromGrowingToShrinking) {
  // b grows at its right end up to iteration 60 and shrinks at its left one from 80 on.
  const auto grow_and_shrink = [](Iteration k) {
    return Hidden{ramp(k, 80, 110, 0.0, 3.0), ramp(k, 0, 60, 3.0, 0.0)};
  };
  const Track a = track_of(0, kAlong, {0, 110}, straight),
              b = track_of(1, kAhead, {0, 110}, straight, grow_and_shrink);
  ASSERT_EQ(b.phases().size(), 2u);
  EXPECT_EQ(b.phases()[0].interval, (Interval{0, 80}));
  EXPECT_EQ(b.phases()[0].trend, Trend::growing);
  EXPECT_EQ(b.phases()[1].interval, (Interval{81, 110}));
  EXPECT_EQ(b.trend(), Trend::shrinking);
  PairComparer comparer{CompareOptions{}};
  const Comparison comparison = comparer.compare(a, b);
  EXPECT_EQ(comparison.interval, (Interval{0, 80}));  // as large as in the other one, and longer
  EXPECT_EQ(comparison.key[1], KeyPoint::left);
  EXPECT_LT(error_of(comparison, kAlong, kAhead), kExact);
}

TEST(Rule19, AKeyPointThatIsNeededInAnotherIntervalIsFoundThere) {
  // b shrinks at its right end in [0, 30] and is cut at the left one, by more and more, in [60, 160].
  const auto hide = [](Iteration k) {
    return k <= 30 ? Hidden{0.0, ramp(k, 0, 30, 3.0, 4.0)} : Hidden{ramp(k, 60, 160, 0.0, 2.0), 0.0};
  };
  const Track a = track_of(0, kAlong, {0, 160}, straight);
  Track b(1, TrackOptions{});
  for (Iteration k = 0; k <= 160; ++k) {
    if (k <= 30 || k >= 60) b.push(seen(kAhead, straight(k), k, hide(k).left, hide(k).right));
  }
  PairComparer comparer{CompareOptions{}};
  const std::vector<const Track*> others{&a};
  ASSERT_EQ(comparer.compare(a, b).interval, (Interval{60, 160}));
  EXPECT_EQ(recalculated_key(comparer, b, {0, 30}, others), KeyPoint::left);
}

TEST(Rule20, AnIterationInWhichAPlaneIsTooLargeTakesNoPart) {
  const auto spike = [](Iteration k) { return Hidden{k == 17 ? -0.4 : 0.0, 0.0}; };
  const Track a = track_of(0, kAlong, {0, 40}, straight), b = track_of(1, kAhead, {0, 40}, straight, spike);
  PairComparer comparer{CompareOptions{}};
  const Comparison comparison = comparer.compare(a, b);
  EXPECT_NEAR(comparison.size[1], kAhead.length(), kExact);
  EXPECT_EQ(comparison.shared, 40);
  EXPECT_LT(error_of(comparison.placement(1), kAlong, kAhead), kExact);
}

TEST(Rule28, SizesAreBroughtToOneWherePairsAreChained) {
  // Plane 0 grows to its whole size while it is seen with plane 1; later, with plane 2, only a part of it is seen.
  const auto cut = [](Iteration k) {
    return Hidden{0.0, k <= 50 ? ramp(k, 0, 20, 1.0, 0.0) : ramp(k, 60, 100, 4.0, 3.0)};
  };
  Track shared(0, TrackOptions{});
  for (Iteration k = 0; k <= 100; ++k) {
    if (k <= 50 || k >= 60) shared.push(seen(kAlong, straight(k), k, cut(k).left, cut(k).right));
  }
  const Track first = track_of(1, kAhead, {0, 50}, straight),
              last = track_of(2, kSlanted, {60, 100}, straight);
  PairComparer comparer{CompareOptions{}};
  const std::vector<const Track*> members{&first, &shared, &last};
  const auto placements = place_members(comparer, members, std::vector<PairEdge>{{0, 1}, {1, 2}});
  ASSERT_TRUE(placements[2].valid);
  EXPECT_LT(error_of(placements[2], kAhead, kSlanted), kExact);
}

TEST(Rule30, PairsAreChosenThatWereSeenTogetherLongest) {
  // In the order of arrival 1 and 2 would be compared, over 5 iterations.
  const Track a = track_of(0, kAlong, {0, 200}, straight), b = track_of(1, kAhead, {0, 100}, straight);
  const Track c = track_of(2, kSlanted, {96, 200}, straight);
  PairComparer comparer{CompareOptions{}};
  const std::vector<const Track*> members{&a, &b, &c};
  EXPECT_EQ(order_comparisons(comparer, members), (std::vector<PairEdge>{{0, 1}, {0, 2}}));
}

TEST(Rule31, AMemberIsConfirmedWhenItWasComparedForLongEnough) {
  const Track a = track_of(0, kAlong, {0, 100}, straight), b = track_of(1, kAhead, {0, 100}, straight);
  const Track brief = track_of(2, kSlanted, {95, 100}, straight);
  PairComparer comparer{CompareOptions{}};
  EXPECT_EQ(judge_member(comparer.compare(a, b), 0, 20, IntervalOptions{}), Membership::confirmed);
  EXPECT_EQ(judge_member(comparer.compare(a, brief), 95, 100, IntervalOptions{}), Membership::undecided);
  EXPECT_EQ(shrinkage({{0, 100}}, brief), 95);
  EXPECT_EQ(shrinkage({{0, 100}}, b), 0);
}

TEST(Rule32, AMemberThatWasNotComparedForLongEnoughIsFoundOutInTime) {
  const Comparison none;
  EXPECT_EQ(judge_member(none, 100, 129, IntervalOptions{}), Membership::undecided);
  EXPECT_EQ(judge_member(none, 100, 130, IntervalOptions{}), Membership::too_short);
}

}  // namespace
}  // namespace hallway::slam_plane::thesis::test
