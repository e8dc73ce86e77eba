// SPDX-License-Identifier: MIT
// One test for each rule about the map, the pose, and what is kept (thesis 4.3). See pair_rules_test.cpp.
#include <gtest/gtest.h>

#include <vector>

#include "slam_plane/thesis/map_report.hpp"
#include "slam_plane/thesis/steps.hpp"
#include "unit/slam_plane_thesis/small_world.hpp"

namespace hallway::slam_plane::thesis::test {
namespace {

/// By how much a pose is off [m, rad].
double pose_error(const Pose2& pose, const Pose2& truth) {
  return std::max((pose.t - truth.t).norm(), (pose.r - truth.r).norm());
}

TEST(Rule04, TheMapIsAlignedToThePlanesOfTheFirstIteration) {
  SmallWorld world;
  const TrackId a = world.see(kAlong, {{0, 40}}), b = world.see(kAhead, {{0, 40}});
  world.group({a, b});
  anchor_first(world.state);
  const std::vector<SubmapIndex> changed{0};
  world.state.map.build(changed, world.state.submaps, world.state.tracks);
  EXPECT_LT(world.error_in_map(a), kExact);  // the robot began at the origin, and is elsewhere now
  EXPECT_LT(world.error_in_map(b), kExact);
}

TEST(Rule05, ThePoseIsWhereTheLastSightingsLieOnTheMap) {
  SmallWorld world;
  const TrackId a = world.see(kAlong, {{0, 40}}), b = world.see(kAhead, {{0, 40}});
  world.fixed_group({a, b});
  world.set_now(40);
  world.state.locator.note(world.state.submaps[0], 40);
  for (const Pose2& guess : {Pose2{}, Pose2::at(Vec2(7, -3), 1.0)}) {  // no pose of before matters
    const auto found = world.state.locator.locate(world.state.seen, world.state.tracks, world.state.map,
                                                  world.state.pairs, 40, guess);
    ASSERT_TRUE(found && found->determined);
    EXPECT_LT(pose_error(found->T_to_from, straight(40)), kExact);
  }
}

TEST(Rule06, SubmapsAreCombinedToOneMapByThePlanesThatLinkThem) {
  SmallWorld world;
  const TrackId a = world.see(kAlong, {{0, 90}}), b = world.see(across(5), {{0, 50}});
  const TrackId c = world.see(across(7), {{0, 90}}), d = world.see(across(9), {{60, 90}});
  world.fixed_group({a, b, c});
  const std::vector<SubmapIndex> next{world.group({a, c, d}, {0})};
  EXPECT_EQ(world.state.map.find(d), nullptr);
  world.state.map.build(next, world.state.submaps, world.state.tracks);
  for (const TrackId id : {a, b, c, d}) EXPECT_LT(world.error_in_map(id), kExact);
}

/// Of the right part of a wall more and more is hidden, from iteration 60 on.
Hidden right_part_later(Iteration k) {
  return {0.0, k < 60 ? 0.0 : 1.0 + 0.05 * static_cast<double>(k - 60)};
}

TEST(Rule17, InALinkTheSmallerViewOfAPlaneIsComparedFromItsKeyPoint) {
  // Of b the earlier submap knows five metres, the later one the whole wall.
  const auto right_part_at_first = [](Iteration k) {
    return Hidden{0.0, k > 40 ? 0.0 : 2.0 - 0.025 * static_cast<double>(k)};
  };
  SmallWorld world;
  const TrackId a = world.see(kAlong, {{0, 40}});
  const TrackId b = world.see(kAhead, {{0, 40}}, straight, right_part_at_first);
  world.fixed_group({a, b});
  for (const TrackId id : {a, b}) world.see_again(id, {60, 100});
  const TrackId c = world.see(across(9), {{60, 100}});
  const std::vector<Submap>& submaps = world.state.submaps;
  const SubmapIndex later = world.group({a, b, c}, {0});
  ASSERT_NEAR(submaps[0].find(b)->reference.place.size, 5.0, 0.1);
  ASSERT_NEAR(submaps[later].find(b)->reference.place.size, 6.0, kExact);
  const std::optional<Pose2> T = MapBuilder::link(later, submaps);
  ASSERT_TRUE(T.has_value());
  EXPECT_LT((*T * submaps[later].find(c)->reference.place.middle - across(9).middle()).norm(), kExact);
}

TEST(Rule19, AKeyPointOfAnotherIntervalIsNotUsedButFoundAnew) {
  SmallWorld world;
  const TrackId a = world.see(kAlong, {{0, 40}}), b = world.see(kAhead, {{0, 40}});
  world.fixed_group({a, b});
  State& state = world.state;
  state.locator.note(state.submaps[0], 40);
  ASSERT_TRUE(state.locator.seen(state.tracks[b], 40).full());
  for (Iteration k = 60; k <= 100; ++k) {
    for (const TrackId id : {a, b}) world.see_again(id, {k, k}, right_part_later(k).right);
    state.pairs.update(state.tracks[a], state.tracks[b]);
  }
  world.set_now(100);
  ASSERT_TRUE(state.locator.locate(state.seen, state.tracks, state.map, state.pairs, 100, Pose2{}));
  const Reference now = state.locator.seen(state.tracks[b], 100);
  EXPECT_TRUE(now.known[kEndA]);
  EXPECT_FALSE(now.known[kEndB]);
}

TEST(Rule11, APlaneThatNoTrackJustSawIsLookedForInTheMapWhereThePoseIs) {
  const Pose2 pose = Pose2::at(Vec2(1.0, -0.5), 0.3);
  for (const bool pose_is_right : {true, false}) {
    SmallWorld world;
    const TrackId a = world.see(kAlong, {{0, 50}}), b = world.see(across(5), {{0, 50}});
    world.fixed_group({a, b});
    const auto at_pose = [&](Iteration) { return pose; };
    const TrackId unknown = world.see(across(5), {{119, 119}}, at_pose);
    world.state.carried.unassigned.push_back({unknown, -1, std::nullopt});
    world.state.carried.located = true;
    world.state.carried.motion.known(pose_is_right ? pose : Pose2::at(Vec2(-1.0, -0.5), 0.3));
    world.state.now = 120;
    match_with_map(world.options, world.state);
    EXPECT_EQ(world.state.met_again, pose_is_right ? std::vector<TrackId>{b} : std::vector<TrackId>{});
    EXPECT_EQ(world.state.tracks[b].newest().iteration, pose_is_right ? 119 : 50);
    EXPECT_EQ(world.state.carried.unassigned.size(), pose_is_right ? 0u : 1u);
  }
}

TEST(Rule23, OfOnePlaneAloneOnlyItsGrowingIsOfInterest) {
  // The map has five metres of the wall, of which the right end was never seen; alone in view, half a metre more of it is seen, and its left end is not.
  SmallWorld world;
  const auto cut = [](Iteration k) { return Hidden{0.0, 2.0 - 0.025 * static_cast<double>(k)}; };
  const TrackId a = world.see(kAlong, {{0, 40}}), b = world.see(across(5), {{0, 40}}, straight, cut);
  world.fixed_group({a, b});
  const Reference before = world.state.map.find(b)->reference;
  ASSERT_NEAR(before.place.size, 5.0, 0.1);
  const Pose2 pose = Pose2::at(Vec2(0.5, 0.2), -0.4);
  const TimedObservation part = seen(across(5), pose, 100, 2.0, 0.5);
  world.state.map.expand(b, pose * part.segment, 100);
  const Reference after = world.state.map.find(b)->reference;
  EXPECT_LT((after.place.segment().end[kEndB] - Vec2(5, -2.5)).norm(), kExact);
  EXPECT_LT((after.place.segment().end[kEndA] - before.place.segment().end[kEndA]).norm(), kExact);
  EXPECT_LT((after.place.direction - before.place.direction).norm(), kExact);
  EXPECT_FALSE(after.known[kEndB]);
}

TEST(Rule35, ASubmapThatCanNoLongerBeComputedIsAsItWasAtItsBest) {
  // What was seen of the one plane together with the other one is gone, and so is what was made of it.
  SmallWorld world;
  world.options.storage = 50;
  world.state.tracks = TrackBook(world.options.track());
  const TrackId a = world.see(kAlong, {{0, 40}}), b = world.see(across(5), {{0, 40}});
  Submap& submap = world.state.submaps[world.fixed_group({a, b})];
  const Reference best = submap.find(b)->reference;
  ASSERT_TRUE(best.valid());
  world.see_again(a, {41, 140});
  world.state.pairs.forget(b);
  ASSERT_TRUE(submap.compute(world.state.pairs, world.state.tracks, world.options, 140));
  ASSERT_EQ(world.state.pairs.update(world.state.tracks[a], world.state.tracks[b]).shared(), 0);
  const Reference& kept = submap.find(b)->reference;
  ASSERT_TRUE(kept.valid());
  EXPECT_LT((kept.place.middle - best.place.middle).norm(), kExact);
  EXPECT_NEAR(kept.place.size, best.place.size, kExact);
}

TEST(Rule36, TheBestComparisonIsKeptWhenItsSightingsAreGone) {
  TrackOptions small;
  small.capacity = 50;
  PlaneTrack a(0, small), b(1, small);
  StaticPairs pairs{CompareOptions{}};
  for (Iteration k = 0; k < 140; ++k) {
    a.push(seen(kAlong, straight(k), k));
    if (k < 40) b.push(seen(kAhead, straight(k), k));
    pairs.update(a, b);
  }
  ASSERT_EQ(a.find(39), nullptr);
  const PairHistory& history = pairs.update(a, b);
  ASSERT_EQ(history.shared(), 40);
  EXPECT_LT(error_of(history.saved.front(), kAlong, kAhead), kExact);
}

/// The walls that a map of these ones, beside a robot on its way along x, is told as.
std::vector<WallLandmark> told_of(std::initializer_list<Segment> walls) {
  SmallWorld world;
  std::vector<TrackId> ids{world.see(kAhead, {{0, 60}})};
  for (const Segment& wall : walls) ids.push_back(world.see(wall, {{0, 60}}));
  const SubmapIndex made = world.state.submaps.size();
  world.state.submaps.emplace_back(made, world.state.start);
  for (const TrackId id : ids) {
    world.state.submaps[made].add(id, world.state.start, false);
    world.state.tracks.submaps(id).push_back(made);
  }
  world.state.submaps[made].compute(world.state.pairs, world.state.tracks, world.options, 60);
  world.fix(made);
  std::vector<WallLandmark> told = report_map(world.state).walls;
  std::erase_if(told, [](const WallLandmark& wall) { return wall.id == 0; });
  return told;
}

Segment left_of_the_way(double from, double to, double y = 2.0) {
  return {{Vec2(from, y), Vec2(to, y)}};
}

TEST(MapReport, PlanesOfOneLineThatShareSomeOfItAreOneWall) {
  for (const bool turned : {false, true}) {
    const Segment first = left_of_the_way(-2, 6), second = left_of_the_way(5, 9, 2.03);
    const std::vector<WallLandmark> told = turned ? told_of({second, first}) : told_of({first, second});
    ASSERT_EQ(told.size(), 1u);
    EXPECT_EQ(told[0].id, 1u) << "the older one's name";
    EXPECT_LT((told[0].a - Vec2(-2, 2)).norm(), 1e-6);
    EXPECT_LT((told[0].b - Vec2(9, 2)).norm(), 1e-6) << "in the line of the longer one";
    EXPECT_TRUE(told[0].certain[kEndA] && told[0].certain[kEndB]);
    EXPECT_EQ(told[0].observations, 122u);
  }
}

TEST(MapReport, AChainOfPartsIsOneWallToo) {
  const std::vector<WallLandmark> told = told_of(
      {left_of_the_way(-2, 1), left_of_the_way(5, 9), left_of_the_way(3.5, 5.5), left_of_the_way(0, 4)});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_LT((told[0].a - Vec2(-2, 2)).norm(), 1e-6);
  EXPECT_LT((told[0].b - Vec2(9, 2)).norm(), 1e-6);
}

TEST(MapReport, WallsThatOnlyTouchOrLieBesideEachOtherAreTwo) {
  EXPECT_EQ(told_of({left_of_the_way(-2, 6), left_of_the_way(5.95, 9)}).size(), 2u);
  EXPECT_EQ(told_of({left_of_the_way(-2, 6), left_of_the_way(6.8, 9)}).size(), 2u) << "a door";
  EXPECT_EQ(told_of({left_of_the_way(-2, 6), left_of_the_way(5, 9, 2.2)}).size(), 2u);
}

}  // namespace
}  // namespace hallway::slam_plane::thesis::test
