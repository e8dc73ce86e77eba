// SPDX-License-Identifier: MIT
// One test for each rule about matching, tracks and pairs (thesis 4.3). tests/mutation takes each rule away and expects its test, and no other rule's, to fail.
// So each uses as little as possible of what other rules say: the robot drives along x without turning, and of two planes the first one lies along x, unless the rule is about that.
#include <gtest/gtest.h>

#include <algorithm>

#include "slam_plane/thesis/locator.hpp"
#include "slam_plane/thesis/matching.hpp"
#include "slam_plane/thesis/membership.hpp"
#include "slam_plane/thesis/reference.hpp"
#include "slam_plane/thesis/submap.hpp"
#include "unit/slam_plane_thesis/walls.hpp"

namespace hallway::slam_plane::thesis::test {
namespace {

double ramp(Iteration k, Iteration from, Iteration to, double first, double last) {
  const double share = static_cast<double>(k - from) / static_cast<double>(to - from);
  return first + std::clamp(share, 0.0, 1.0) * (last - first);
}

constexpr int kLeftLeft = 0;  // combination of ends

/// What StaticPairs finds out when it is shown both tracks observation by observation.
PairHistory history_of(const PlaneTrack& a, const PlaneTrack& b) {
  PlaneTrack seen_a(a.id(), TrackOptions{}), seen_b(b.id(), TrackOptions{});
  StaticPairs pairs{CompareOptions{}};
  for (Iteration k = 0; k <= std::max(a.newest().iteration, b.newest().iteration); ++k) {
    if (const TimedObservation* observation = a.find(k)) seen_a.push(*observation);
    if (const TimedObservation* observation = b.find(k)) seen_b.push(*observation);
    pairs.update(seen_a, seen_b);
  }
  return pairs.update(seen_a, seen_b);
}

/// Places the planes of the second one and the third one in the frame of the first one, along a chain.
std::vector<Reference> chain(const Comparison& first, const Comparison& second) {
  std::vector<Reference> references{reference_of(first, 0)};
  references.push_back(chained(references[0], first));
  references.push_back(chained(references[1], second));
  return references;
}

/// Two tracks, which lie on kAlong and kAhead, in a submap that is placed where the world is.
struct TwoMapped {
  Options options;
  TrackBook tracks{options.track()};
  StaticPairs pairs{options.compare()};
  std::vector<Submap> submaps;
  MapBuilder map{options};

  TwoMapped() {
    tracks.create(0);
    tracks.create(0);
    for (Iteration k = 0; k <= 40; ++k) {
      tracks[0].push(seen(kAlong, straight(k), k));
      tracks[1].push(seen(kAhead, straight(k), k));
      pairs.update(tracks[0], tracks[1]);
    }
    submaps.emplace_back(0, 0);
    for (const TrackId id : {TrackId{0}, TrackId{1}}) {
      submaps[0].add(id, 0, false);
      tracks.submaps(id).push_back(0);
      const Segment& wall = id == 0 ? kAlong : kAhead;
      submaps[0].anchors.push_back(
          {id, {{wall.middle(), wall.direction(), wall.length(), true}, {true, true}, 40}});
    }
    submaps[0].compute(pairs, tracks, options, 40);
    const std::vector<SubmapIndex> all{0};
    map.build(all, submaps, tracks);
  }
};

TEST(Rule01, SightingsAreMatchedToTheLatestOnesOfTracksWithoutAPose) {
  PlaneTrack track(0, TrackOptions{}), other(1, TrackOptions{});
  for (Iteration k = 0; k < 100; ++k) {
    const Pose2 pose =
        Pose2::at(Vec2(0.05 * static_cast<double>(k), 0.0), 0.1 * std::sin(0.3 * static_cast<double>(k)));
    const std::vector<TimedObservation> now{seen(kAhead, pose, k), seen(kAlong, pose, k)};
    if (k > 0) {
      const std::vector<std::vector<const PlaneTrack*>> stages{{&track, &other}};
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
  PlaneTrack a(0, TrackOptions{}), b(1, TrackOptions{}), c(2, TrackOptions{});
  for (Iteration k = 0; k < 60; ++k) {
    a.push(seen(kAlong, straight(k), k));
    if (k % 5 != 2) b.push(seen(behind, straight(k), k));
    if (k % 7 != 3) c.push(seen(farther, straight(k), k));
  }
  PairComparer comparer{CompareOptions{}};
  const Interval all{0, 59};
  const Comparison ab = comparer.compare_in(a, b, all, kLeftLeft),
                   bc = comparer.compare_in(b, c, all, kLeftLeft),
                   ac = comparer.compare_in(a, c, all, kLeftLeft);
  const std::vector<Reference> one = chain(ab, bc), another = chain(ac, inverse(bc));
  for (const auto& [in_b, in_c] : {std::pair{one[1], one[2]}, std::pair{another[2], another[1]}}) {
    ASSERT_TRUE(in_b.valid() && in_c.valid());
    EXPECT_LT(error_of(in_b.place, kAlong, behind), kExact);
    EXPECT_LT(error_of(in_c.place, kAlong, farther), kExact);
  }
}

TEST(Rule03, RelativePlaceIsTheSameHoweverTheRobotTurns) {
  for (const auto& [first, second] :
       {std::pair{kAlong, kAhead}, std::pair{kSlanted, kAlong}, std::pair{kAhead, kFacing}}) {
    const PlaneTrack a = track_of(0, first, {0, 80}, curved), b = track_of(1, second, {0, 80}, curved);
    PairComparer comparer{CompareOptions{}};
    const Comparison comparison = comparer.compare_in(a, b, {0, 80}, kLeftLeft);
    ASSERT_TRUE(comparison.has_keys());
    EXPECT_LT(error_of(comparison, first, second), kExact);
    EXPECT_LT(comparison.deviation, kExact);
  }
}

TEST(Rule07, MembersWereAllVisibleTogether) {
  const PlaneTrack a = track_of(0, kAlong, {0, 100}, straight), b = track_of(1, kAhead, {50, 150}, straight);
  const PlaneTrack late = track_of(2, kSlanted, {120, 150}, straight),
                   early = track_of(3, kSlanted, {0, 30}, straight);
  const PlaneTrack with_both = track_of(4, kSlanted, {40, 90}, straight);
  const std::vector<const PlaneTrack*> members{&a, &b};
  const Intervals common = common_intervals(members);
  ASSERT_EQ(common, (Intervals{{50, 100}}));
  EXPECT_FALSE(fits(common, late, 10));
  EXPECT_FALSE(fits(common, early, 10));
  EXPECT_TRUE(fits(common, with_both, 10));
}

TEST(Rule09, SubmapsAreLinkedByThePlanesThatCameIntoViewLast) {
  const PlaneTrack oldest = track_of(0, kAlong, {0, 100}, straight),
                   old = track_of(1, kAhead, {20, 100}, straight);
  const PlaneTrack gone = track_of(2, kFacing, {70, 80}, straight),
                   young = track_of(3, kSlanted, {60, 100}, straight);
  const PlaneTrack newcomer = track_of(4, kSlanted, {90, 100}, straight);
  const std::vector<const PlaneTrack*> members{&oldest, &old, &gone, &young};
  EXPECT_EQ(linking_members(members, newcomer, 2), (std::vector<int>{3, 1}));
}

TEST(Rule10, TheOtherSideOfAThinWallIsAnotherPlane) {
  PlaneTrack track(0, TrackOptions{});
  track.push(*make_observation({Vec2(2, 0.05), Vec2(4, 0.05)}, 0));
  const std::vector<std::vector<const PlaneTrack*>> stages{{&track}};
  const std::vector<TimedObservation> same{*make_observation({Vec2(2, 0.01), Vec2(4, 0.01)}, 1)};
  const std::vector<TimedObservation> behind{*make_observation({Vec2(4, -0.01), Vec2(2, -0.01)}, 1)};
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
    const PlaneTrack a = track_of(0, kAlong, {0, 50}, straight, hide(left_a));
    const PlaneTrack b = track_of(1, kAhead, {0, 50}, straight, hide(left_b));
    const PairHistory history = history_of(a, b);
    ASSERT_EQ(history.saved.size(), 1u);
    const Comparison& comparison = history.saved.front();
    EXPECT_EQ(comparison.key[0], left_a ? KeyPoint::left : KeyPoint::right);
    EXPECT_EQ(comparison.key[1], left_b ? KeyPoint::left : KeyPoint::right);
    EXPECT_LT(error_of(comparison, kAlong, kAhead), kExact);
    EXPECT_LT(comparison.deviation, kExact);
  }
}

TEST(Rule14, EndsAreNumberedAsTheRobotSeesThem) {
  PlaneTrack a(0, TrackOptions{}), b(1, TrackOptions{});
  for (Iteration k = 0; k < 40; ++k) {
    const TimedObservation told = seen(kAhead, straight(k), k);
    WallObservation observation{told.segment.end[0], told.segment.end[1], 0.0, 2.5};
    if (k % 2 == 1) std::swap(observation.a, observation.b);
    b.push(*make_observation(observation, k));
    a.push(seen(kAlong, straight(k), k));
    EXPECT_GT(b.newest().segment.end[kEndA].y(), b.newest().segment.end[kEndB].y());
    EXPECT_LT(b.newest().segment.normal().x(), 0.0);  // faces the robot
  }
  PairComparer comparer{CompareOptions{}};
  const Comparison comparison = comparer.compare_in(a, b, {0, 39}, kLeftLeft);
  ASSERT_TRUE(comparison.has_keys());
  EXPECT_LT(error_of(comparison, kAlong, kAhead), kExact);
}

TEST(Rule15, ParallelPlanesThatGrowTogetherHaveNoKeyPointsThoughTheOffsetIsRight) {
  // Two walls on the same side, one behind the other, both cut by the view's far end.
  const Segment behind{{Vec2(-1, 3), Vec2(7, 3)}};
  const auto grow = [](Iteration k) { return Hidden{0.0, ramp(k, 0, 50, 4.0, 1.0)}; };
  const PlaneTrack a = track_of(0, kAlong, {0, 50}, straight, grow),
                   b = track_of(1, behind, {0, 50}, straight, grow);
  const PairHistory history = history_of(a, b);
  for (int end = 0; end < 2; ++end) EXPECT_FALSE(history.still(0, end) || history.still(1, end));
  ASSERT_FALSE(history.saved.empty());
  for (const Comparison& comparison : history.saved) {
    EXPECT_FALSE(comparison.has_keys());
    EXPECT_TRUE(comparison.parallel);
    EXPECT_NEAR(std::abs(comparison.offset.y()), 1.0, kExact);
  }
}

TEST(Rule16, WhatIsSeenOfAPlaneIsComparedWithTheMapAtItsKeyPoint) {
  TwoMapped world;
  Locator locator{world.options};
  const Pose2 truth = Pose2::at(Vec2(1.0, 0.3), 0.2);
  world.tracks[0].push(seen(kAlong, truth, 41, 0.0, 3.0));  // a part, of which the left end is the wall's
  locator.note(0, {true, false}, 41);
  const std::vector<TrackId> now{0};
  const auto location = locator.locate(now, world.tracks, world.map, world.pairs, 41, truth);
  ASSERT_TRUE(location && location->by_points);
  EXPECT_LT((location->T_to_from.t - truth.t).norm(), kExact);
}

TEST(Reference, OfTwoViewsOfAPlaneWhatBothKnowIsComparedWhateverTheirSizes) {
  const Reference whole{{Vec2(0, 0), Vec2(1, 0), 6.0, true}, {true, true}, 10};
  const Reference part{{Vec2(11, 3), Vec2(0, 1), 2.0, true}, {false, true}, 10};
  std::vector<PlanePair> pairs;
  append_pairs(part, whole, pairs);
  const auto alignment = align(pairs, Pose2{});
  ASSERT_TRUE(alignment && alignment->by_points);
  EXPECT_LT((alignment->T_to_from * Vec2(11, 4) - Vec2(3, 0)).norm(), kExact);  // its right end
  EXPECT_LT((alignment->T_to_from.rotate(Vec2(0, 1)) - Vec2(1, 0)).norm(), kExact);
}

TEST(Rule18, TimeIsSplitWhereAPlaneTurnsFromGrowingToShrinking) {
  // b grows at its right end up to iteration 60 and shrinks at its left one from 80 on.
  const auto grow_and_shrink = [](Iteration k) {
    return Hidden{ramp(k, 80, 110, 0.0, 3.0), ramp(k, 0, 60, 3.0, 0.0)};
  };
  const PlaneTrack a = track_of(0, kAlong, {0, 110}, straight),
                   b = track_of(1, kAhead, {0, 110}, straight, grow_and_shrink);
  ASSERT_EQ(b.phases().size(), 2u);
  EXPECT_EQ(b.phases()[0].interval, (Interval{0, 80}));
  EXPECT_EQ(b.phases()[0].trend, Trend::growing);
  EXPECT_EQ(b.phases()[1].interval, (Interval{81, 110}));
  EXPECT_EQ(b.trend(), Trend::shrinking);
  const PairHistory history = history_of(a, b);
  int right = 0;
  for (const Comparison& comparison : history.saved) {
    EXPECT_LT(error_of(comparison, kAlong, kAhead), kExact);
    if (comparison.key[1] == KeyPoint::left) {
      EXPECT_EQ(comparison.interval, (Interval{0, 80}));
    } else {
      EXPECT_EQ(comparison.interval, (Interval{81, 110}));
      ++right;
    }
  }
  EXPECT_GT(right, 0);
}

TEST(Locator, AKeyPointThatNoSubmapTellsIsFoundInTheIntervalOfNow) {
  TwoMapped world;
  Locator locator{world.options};  // to which nothing is noted
  for (const TrackId id : {TrackId{0}, TrackId{1}})
    world.tracks[id].push(seen(id == 0 ? kAlong : kAhead, straight(41), 41));
  const std::vector<TrackId> now{0, 1};
  const auto location = locator.locate(now, world.tracks, world.map, world.pairs, 41, Pose2{});
  ASSERT_TRUE(location.has_value());
  EXPECT_TRUE(location->by_points);
  EXPECT_LT((location->T_to_from.t - straight(41).t).norm(), kExact);
}

TEST(Rule20, AnIterationInWhichAPlaneIsTooLargeTakesNoPart) {
  const auto spike = [](Iteration k) { return Hidden{k == 17 ? -0.4 : 0.0, 0.0}; };
  const PlaneTrack a = track_of(0, kAlong, {0, 40}, straight),
                   b = track_of(1, kAhead, {0, 40}, straight, spike);
  PairComparer comparer{CompareOptions{}};
  const Comparison comparison = comparer.compare_in(a, b, {0, 40}, kLeftLeft);
  EXPECT_NEAR(comparison.size[1], kAhead.length(), kExact);
  EXPECT_EQ(comparison.shared, 40);
  EXPECT_LT(error_of(comparison.placement(1), kAlong, kAhead), kExact);
}

TEST(Rule28, SizesAreBroughtToOneWherePairsAreChained) {
  // Plane 0 grows to its whole size while it is seen with plane 1; later, with plane 2, only a part of it is seen.
  const auto cut = [](Iteration k) {
    return Hidden{0.0, k <= 50 ? ramp(k, 0, 20, 1.0, 0.0) : ramp(k, 60, 100, 4.0, 3.0)};
  };
  PlaneTrack shared(0, TrackOptions{});
  for (Iteration k = 0; k <= 100; ++k) {
    if (k <= 50 || k >= 60) shared.push(seen(kAlong, straight(k), k, cut(k).left, cut(k).right));
  }
  const PlaneTrack first = track_of(1, kAhead, {0, 50}, straight),
                   last = track_of(2, kSlanted, {60, 100}, straight);
  PairComparer comparer{CompareOptions{}};
  const std::vector<Reference> references = chain(comparer.compare_in(first, shared, {0, 50}, kLeftLeft),
                                                  comparer.compare_in(shared, last, {60, 100}, kLeftLeft));
  ASSERT_TRUE(references[2].valid());
  EXPECT_LT(error_of(references[2].place, kAhead, kSlanted), kExact);
}

TEST(Rule30, PairsAreChosenThatWereSeenTogetherLongest) {
  // In the order of arrival the second and the third one would be compared, over 5 iterations.
  Options options;
  TrackBook tracks{options.track()};
  StaticPairs pairs{options.compare()};
  const Segment* walls[] = {&kAlong, &kAhead, &kSlanted};
  const Interval visible[] = {{0, 200}, {0, 100}, {96, 200}};
  for (int i = 0; i < 3; ++i) tracks.create(0);
  for (Iteration k = 0; k <= 200; ++k) {
    for (TrackId i = 0; i < 3; ++i) {
      if (visible[i].contains(k)) tracks[i].push(seen(*walls[i], straight(k), k));
      for (TrackId j = 0; j < i; ++j) pairs.update(tracks[j], tracks[i]);
    }
  }
  Submap submap(0, 0);
  for (const TrackId id : {TrackId{1}, TrackId{2}, TrackId{0}}) submap.add(id, 100, false);
  submap.compute(pairs, tracks, options, 200);
  ASSERT_TRUE(submap.find(1)->reference.valid() && submap.find(2)->reference.valid());
  EXPECT_EQ(submap.find(2)->parent, 0u);
  EXPECT_GE(submap.find(1)->comparison.shared, 100);
  EXPECT_GE(submap.find(2)->comparison.shared, 100);
}

TEST(Rule31, AMemberIsConfirmedWhenItWasComparedForLongEnough) {
  const PlaneTrack a = track_of(0, kAlong, {0, 100}, straight), b = track_of(1, kAhead, {0, 100}, straight);
  const PlaneTrack brief = track_of(2, kSlanted, {95, 100}, straight);
  PairComparer comparer{CompareOptions{}};
  EXPECT_EQ(judge_member(comparer.compare_in(a, b, {0, 100}, kLeftLeft), 0, 20, Options{}),
            Membership::confirmed);
  EXPECT_EQ(judge_member(comparer.compare_in(a, brief, {0, 100}, kLeftLeft), 95, 100, Options{}),
            Membership::undecided);
}

TEST(Membership, AMemberThatWasNotComparedForLongEnoughIsFoundOutInTime) {
  const Comparison none;
  EXPECT_EQ(judge_member(none, 100, 129, Options{}), Membership::undecided);
  EXPECT_EQ(judge_member(none, 100, 130, Options{}), Membership::too_short);
}

}  // namespace
}  // namespace hallway::slam_plane::thesis::test
