// SPDX-License-Identifier: MIT
// One test for each rule about submaps: who joins which, what links them, which is the current one (thesis 4.3). See pair_rules_test.cpp.
#include <gtest/gtest.h>

#include <vector>

#include "slam_plane/thesis/roll_back.hpp"
#include "slam_plane/thesis/steps.hpp"
#include "unit/slam_plane_thesis/small_world.hpp"

namespace hallway::slam_plane::thesis::test {
namespace {

constexpr Iteration kNow = 120;

TEST(Rule08, TwoPlanesAtLeastLinkASubmapToAnother) {
  for (const bool second_in_view : {false, true}) {
    SmallWorld world;
    const TrackId a = world.see(kAlong, {{0, kNow}});
    const TrackId gone = world.see(across(5), {{0, 50}});
    const TrackId b = world.see(across(7), {{0, second_in_view ? kNow : 50}});
    world.fixed_group({gone, a, b});
    const TrackId newcomer = world.see(across(9), {{105, kNow}});
    world.state.carried.unassigned.push_back({newcomer, -1, std::nullopt});
    world.set_now(kNow);
    manage_submaps(world.options, world.state);
    EXPECT_EQ(world.state.submaps.size(), second_in_view ? 2u : 1u);
  }
  SmallWorld world;
  const TrackId a = world.see(kAlong, {{0, 60}}), b = world.see(across(5), {{0, 60}}),
                c = world.see(across(7), {{0, 60}});
  world.fixed_group({a, b});
  const SubmapIndex by_one = world.group({a, c}, {0}), by_two = world.group({a, b, c}, {0});
  EXPECT_FALSE(MapBuilder::link(by_one, world.state.submaps).has_value());
  EXPECT_TRUE(MapBuilder::link(by_two, world.state.submaps).has_value());
}

TEST(Rule12, AnEarlierSubmapThanTheCurrentOneIsTheBetterLink) {
  // The current submap was made of what was in view for a short time; with the newcomer nothing of it was.
  SmallWorld world;
  const TrackId a = world.see(kAlong, {{0, kNow}}), gone = world.see(across(5), {{0, 50}});
  const TrackId b = world.see(across(7), {{0, kNow}});
  const SubmapIndex earlier = world.fixed_group({gone, a, b});
  const TrackId brief = world.see({{Vec2(-2, 4), Vec2(4, 4)}}, {{60, 80}});
  const TrackId as_brief = world.see(across(9), {{60, 80}});
  const SubmapIndex current = world.fixed_group({brief, as_brief}, {earlier});
  const TrackId newcomer = world.see(across(11), {{105, kNow}});
  world.state.carried.unassigned.push_back({newcomer, -1, std::nullopt});
  world.set_now(kNow);
  ASSERT_EQ(world.state.carried.current, current);
  manage_submaps(world.options, world.state);
  ASSERT_EQ(world.state.submaps.size(), 3u);
  EXPECT_TRUE(world.state.submaps.back().contains(newcomer));
  EXPECT_EQ(world.state.submaps.back().links, (std::vector<SubmapIndex>{earlier}));
}

TEST(Rule21, APlaneThatIsMetAgainGetsASubmapOfItsOwnUnlessItHasEnough) {
  for (const bool enough : {false, true}) {
    SmallWorld world;
    const TrackId a = world.see(kAlong, {{0, kNow}}), again = world.see(across(5), {{0, 50}, {110, kNow}});
    const TrackId b = world.see(across(7), {{0, kNow}});
    world.fixed_group({a, again});
    if (enough) {
      while (world.state.submaps.size() < static_cast<std::size_t>(world.options.max_references))
        world.fixed_group({a, again});
    }
    const SubmapIndex current = world.fixed_group({a, b});
    const std::size_t before = world.state.submaps.size();
    world.state.met_again = {again};
    world.set_now(kNow);
    manage_submaps(world.options, world.state);
    EXPECT_FALSE(world.state.submaps[current].contains(again));
    ASSERT_EQ(world.state.submaps.size(), enough ? before : before + 1);
    if (!enough) {
      EXPECT_TRUE(world.state.submaps.back().contains(again));
    }
  }
}

TEST(Rule22, TheSubmapWithTheMostPlanesInViewIsTheCurrentOne) {
  SmallWorld world;
  const TrackId a = world.see(kAlong, {{0, kNow}}), b = world.see(across(5), {{0, kNow - 1}});
  const TrackId c = world.see(across(7), {{0, kNow}}), d = world.see(across(9), {{0, 50}});
  const SubmapIndex first = world.fixed_group({a, b}), second = world.fixed_group({a, c});
  world.fixed_group({a, d});
  world.set_now(kNow);
  world.state.seen = {a, b, c};
  chart_submaps(world.state);
  EXPECT_EQ(world.state.chart, (std::vector<std::pair<SubmapIndex, int>>{{0, 2}, {1, 2}, {2, 1}}));
  for (const SubmapIndex last : {first, second}) {  // a tie: the last one stays
    world.state.carried.current = last;
    manage_submaps(world.options, world.state);
    EXPECT_EQ(world.state.carried.current, last);
  }
  world.state.seen = {a, c};
  chart_submaps(world.state);
  world.state.carried.current = first;
  manage_submaps(world.options, world.state);
  EXPECT_EQ(world.state.carried.current, second);
}

TEST(Rule29, AfterAMotionModelAnOldSubmapOfAllThatIsSeenIsUsedAgain) {
  SmallWorld world;
  const TrackId a = world.see(kAlong, {{0, kNow}}), again = world.see(across(5), {{0, 50}, {110, kNow}});
  const TrackId b = world.see(across(7), {{0, 90}}), c = world.see(across(9), {{0, 50}});
  const SubmapIndex old = world.fixed_group({a, again, c});
  world.fixed_group({a, b}, {old});
  world.state.carried.after_motion = world.state.carried.located = true;
  world.state.met_again = {again};
  world.set_now(kNow);
  manage_submaps(world.options, world.state);
  EXPECT_EQ(world.state.submaps.size(), 2u);  // none was made
  EXPECT_EQ(world.state.carried.current, old);
}

TEST(Grouping, AfterAMotionModelANewSubmapIsMadeIfNoneHasAllThatIsSeen) {
  SmallWorld world;
  const TrackId a = world.see(kAlong, {{0, 90}}), b = world.see(across(5), {{0, kNow}});
  world.fixed_group({a, b});
  const TrackId newcomer = world.see({{Vec2(-2, 4), Vec2(4, 4)}}, {{105, kNow}});
  world.state.carried.unassigned.push_back({newcomer, -1, std::nullopt});
  world.state.carried.after_motion = world.state.carried.located = true;
  world.set_now(kNow);
  manage_submaps(world.options, world.state);
  ASSERT_EQ(world.state.submaps.size(), 2u);
  EXPECT_TRUE(world.state.submaps.back().contains(b));
  EXPECT_TRUE(world.state.submaps.back().contains(newcomer));
}

TEST(Rule32, AMemberThatWasNotComparedForLongEnoughIsFoundOutInTime) {
  SmallWorld world;  // all join in iteration 0; one of them was never seen together with the others
  const TrackId a = world.see(kAlong, {{0, 20}}), b = world.see(across(5), {{0, 20}});
  const TrackId apart = world.see(across(7), {{25, 27}});
  Submap& submap = world.state.submaps[world.group({a, b, apart})];
  EXPECT_EQ(submap.too_short(world.options, world.options.judge_after - 1), std::nullopt);
  EXPECT_EQ(submap.too_short(world.options, world.options.judge_after), apart);
  EXPECT_TRUE(submap.find(b)->confirmed);
  Hints hints;  // it is not to join this submap again, then none that there is, and then it stays where it is
  hints.add({0, apart, 0});
  EXPECT_FALSE(hints.may_join(apart, 0));
  EXPECT_TRUE(hints.may_join(apart, 1));
  hints.add({0, apart, 1});
  EXPECT_FALSE(hints.may_join(apart, 2));
  EXPECT_FALSE(hints.exhausted(apart));
  hints.add({0, apart, 2});
  EXPECT_TRUE(hints.exhausted(apart));
}

TEST(Rule34, WhatIsHintedAtDoesNotHappenAgain) {
  SmallWorld world;
  State& state = world.state;
  const TrackId a = world.see(kAlong, {{0, 29}}), b = world.see(across(5), {{0, 29}});
  const SubmapIndex submap = world.fixed_group({a, b});
  const TrackId newcomer = world.see(across(7), {{15, 29}});
  state.carried.unassigned.push_back({newcomer, -1, std::nullopt});
  History history(10);
  history.add(29, {});
  world.set_now(29);
  history.close(state);
  const auto iterate = [&] {  // the 30th: all are in view
    for (const TrackId id : {a, b, newcomer}) {
      if (state.tracks[id].newest().iteration < 30)
        state.tracks[id].push(seen(world.walls[id], straight(30), 30));
    }
    history.add(30, {});
    world.set_now(30);
    manage_submaps(world.options, state);
    history.close(state);
  };
  iterate();
  ASSERT_TRUE(state.submaps[submap].contains(newcomer));
  EXPECT_EQ(go_back({30, newcomer, submap}, world.options, history, state).size(), 1u);
  EXPECT_EQ(state.now, 29);
  EXPECT_FALSE(state.submaps[submap].contains(newcomer));
  iterate();
  EXPECT_FALSE(state.submaps[submap].contains(newcomer));
  EXPECT_TRUE(state.submaps[submap].contains(b));
}

TEST(Rule37, WhereAWallWasMappedTwiceTheOlderSubmapCountsBoth) {
  SmallWorld world;
  const TrackId a = world.see(kAlong, {{0, 50}}), again = world.see(across(5), {{0, 50}});
  const TrackId first_time = world.see(across(7), {{0, 50}});
  const SubmapIndex old = world.fixed_group({a, again, first_time});
  world.see_again(a, {80, 100});
  const TrackId second_time = world.see(across(7), {{80, kNow}});
  world.fixed_group({a, second_time}, {old});
  world.see_again(again, {110, kNow});
  world.state.carried.after_motion = world.state.carried.located = true;
  world.state.met_again = {again};
  world.set_now(kNow);
  EXPECT_EQ(world.state.chart.front(), (std::pair<SubmapIndex, int>{old, 1}));
  manage_submaps(world.options, world.state);
  chart_submaps(world.state);
  EXPECT_EQ(world.state.chart.front(), (std::pair<SubmapIndex, int>{old, 2}));
  EXPECT_FALSE(world.state.submaps[old].contains(second_time));  // it does not take part in computing
}

}  // namespace
}  // namespace hallway::slam_plane::thesis::test
