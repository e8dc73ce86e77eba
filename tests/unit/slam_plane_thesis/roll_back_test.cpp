// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/roll_back.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "slam_plane/thesis/bridge.hpp"
#include "slam_plane/thesis/thesis_mapper.hpp"
#include "unit/slam_plane/scenes.hpp"
#include "unit/slam_plane_thesis/small_world.hpp"

namespace hallway::slam_plane::thesis::test {
namespace {

using slam_plane::test::corridor_return;
using slam_plane::test::observe;
using slam_plane::test::Sensor;
using slam_plane::test::TrueFrame;

/// Frames of a corridor, there and back.
std::vector<TrueFrame> corridor(double noise) {
  Sensor sensor;
  sensor.noise_m *= noise;
  sensor.noise_angle_rad *= noise;
  sensor.noise_end_m *= noise;
  sensor.view.horizontal_fov_rad = 1.5707963;
  return observe(corridor_return(), sensor, 2);
}

/// Options by which many a plane is found to have been compared over too little.
Options severe() {
  Options options;
  options.min_interval = 25;
  options.judge_after = 40;
  return options;
}

void expect_same(const Map& a, const Map& b) {
  ASSERT_EQ(a.walls.size(), b.walls.size());
  for (std::size_t i = 0; i < a.walls.size(); ++i) {
    EXPECT_EQ(a.walls[i].id, b.walls[i].id);
    EXPECT_EQ(a.walls[i].a, b.walls[i].a);
    EXPECT_EQ(a.walls[i].b, b.walls[i].b);
    EXPECT_EQ(a.walls[i].observations, b.walls[i].observations);
  }
  ASSERT_EQ(a.submaps.size(), b.submaps.size());
  for (std::size_t i = 0; i < a.submaps.size(); ++i) {
    EXPECT_EQ(a.submaps[i].members, b.submaps[i].members);
    EXPECT_EQ(a.submaps[i].T_map_submap.t, b.submaps[i].T_map_submap.t);
  }
}

TEST(RollBack, WhatIsDoneAgainOverSeveralFramesComesToWhatItComesToAtOnce) {
  for (const double noise : {0.0, 1.0}) {
    ThesisMapper spread{severe()}, at_once{severe()};
    for (const TrueFrame& frame : corridor(noise)) {
      spread.process(frame.observations, View{});
      at_once.process(frame.observations, View{});
      at_once.refined_map();
    }
    EXPECT_GT(at_once.counters().roll_backs, 2u) << "the scene is to have some";
    expect_same(spread.refined_map(), at_once.refined_map());
    EXPECT_EQ(spread.counters().roll_backs, at_once.counters().roll_backs);
    EXPECT_EQ(spread.counters().replayed, at_once.counters().replayed);
  }
}

TEST(RollBack, NoFrameDoesMuchAgainAndTheRobotIsNotLostMeanwhile) {
  const std::vector<TrueFrame> frames = corridor(1.0);
  const Pose2 T_map_world = frames.front().T_world_robot.inverse();
  ThesisMapper mapper{severe()};
  std::uint64_t before = 0, behind = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Answer& answer = mapper.process(frames[i].observations, View{});
    const std::uint64_t again = mapper.counters().replayed - before;
    before += again;
    EXPECT_LE(again, 4u);
    if (again == 0) continue;
    ++behind;
    ASSERT_TRUE(answer.has_pose) << "frame " << i;
    EXPECT_LT((answer.T_map_robot.t - (T_map_world * frames[i].T_world_robot).t).norm(), 0.2)
        << "frame " << i;
  }
  EXPECT_GT(behind, 0u);
}

TEST(RollBack, NoNameStandsForTwoWalls) {
  const std::vector<TrueFrame> frames = corridor(0.0);
  ThesisMapper mapper(severe());
  std::map<LandmarkId, int> wall_of_name;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Answer& answer = mapper.process(frames[i].observations, View{});
    for (std::size_t k = 0; k < frames[i].observations.size(); ++k) {
      const LandmarkId name = answer.associations[k];
      if (name == kNoLandmark) continue;
      const auto [known, fresh] = wall_of_name.try_emplace(name, frames[i].wall[k]);
      ASSERT_EQ(known->second, frames[i].wall[k]) << "name " << name << " in frame " << i;
    }
  }
  EXPECT_GT(mapper.counters().roll_backs, 2u) << "the scene is to have some";
}

/// A wall of which the last centimetres were seen, and the one in line with it, which comes into view while time is rolled back.
TEST(RollBack, WhatComesIntoViewMeanwhileIsNotTakenForTheWallBesideIt) {
  SmallWorld world;
  const Segment gone{{Vec2(-2, 3), Vec2(2, 3)}};
  const auto no_way = [](Iteration) { return Pose2{}; };
  for (const Segment& wall : {kAhead, kSlanted, gone}) world.see(wall, {{0, 40}}, no_way);
  world.fixed_group({0, 1, 2});
  world.set_now(40);
  world.state.recent = world.state.seen;
  Bridge bridge(world.options, world.state);
  const auto observation = [](const Segment& segment) {
    return WallObservation{segment.end[kEndA], segment.end[kEndB], 0.0, 2.5};
  };
  const auto part = [&](double from, double to) {
    return observation(Segment{{Vec2(from, 3), Vec2(to, 3)}});
  };
  const std::vector<WallObservation> both{observation(kAhead), part(1.95, 2.0), part(2.0, 8.0)};
  EXPECT_EQ(bridge.follow(both).associations,
            (std::vector<LandmarkId>{world.state.tracks.name(0), world.state.tracks.name(2), kNoLandmark}));
  for (int i = 0; i < 8; ++i) {
    const std::vector<WallObservation> one{observation(kAhead), part(2.0, 8.0)};
    EXPECT_EQ(bridge.follow(one).associations,
              (std::vector<LandmarkId>{world.state.tracks.name(0), kNoLandmark}));
  }
}

/// Of two walls whose ends stood still, one end each goes out of view.
TEST(RollBack, AnEndThatTheViewCutsMeanwhileIsNoCornerAnyMore) {
  SmallWorld world;
  for (const Segment& wall : {kAhead, kSlanted}) world.see(wall, {{0, 40}});
  world.fixed_group({0, 1});
  world.set_now(40);
  world.state.recent = world.state.seen;
  const bool both[2] = {true, true};
  for (const TrackId id : world.state.seen) {
    ASSERT_NE(world.state.map.find(id), nullptr);
    world.state.locator.note(id, both, 40);
  }
  for (const Iteration k : {39, 40}) world.state.carried.motion.known(straight(k));
  Bridge bridge(world.options, world.state);
  Iteration now = 40;
  for (const double cut : {0.0, 1.0, 1.1, 1.2, 1.3}) {
    ++now;
    std::vector<WallObservation> observations;
    for (const TimedObservation& s :
         {seen(kAhead, straight(now), now, cut), seen(kSlanted, straight(now), now, 0.0, cut)})
      observations.push_back({s.segment.end[kEndA], s.segment.end[kEndB], 0.0, 2.5});
    const std::optional<Alignment> told = bridge.follow(observations).location;
    ASSERT_TRUE(told && told->by_points);
    EXPECT_LT((told->T_to_from.t - straight(now).t).norm(), kExact) << "cut by " << cut;
  }
}

/// A wall of the map that was out of view is met again, and soon no other one is seen.
TEST(RollBack, AWallThatIsMetAgainMeanwhileIsFoundInTheMap) {
  SmallWorld world;
  const TrackId along = world.see(kAlong, {{0, 30}});
  for (const Segment& wall : {kAhead, kSlanted}) world.see(wall, {{0, 40}});
  world.fixed_group({0, 1, 2});
  world.set_now(40);
  world.state.recent = world.state.seen;
  for (const Iteration k : {39, 40}) world.state.carried.motion.known(straight(k));
  Bridge bridge(world.options, world.state);
  for (Iteration now = 41; now < 60; ++now) {
    std::vector<WallObservation> observations;
    const auto see = [&](const Segment& wall) {
      const TimedObservation s = seen(wall, straight(now), now, 0.5, 0.5);
      observations.push_back({s.segment.end[kEndA], s.segment.end[kEndB], 0.0, 2.5});
    };
    see(kAlong);
    if (now < 50) see(kAhead);
    const Bridge::Report told = bridge.follow(observations);
    EXPECT_EQ(told.associations.front(), world.state.tracks.name(along)) << now;
    ASSERT_TRUE(told.location.has_value());
    EXPECT_NEAR(told.location->T_to_from.t.y(), 0.0, kExact) << "the wall along the way tells that";
  }
}

/// Maps a corridor without noise, and at the end goes back over so many iterations, with a hint that forbids nothing.
Map mapped(Iteration back) {
  Options options;
  options.roll_back_limit = 500;
  ThesisMapper mapper(options);
  const std::vector<TrueFrame> frames = corridor(0.0);
  for (const TrueFrame& frame : frames) mapper.process(frame.observations, View{});
  mapper.refined_map();
  if (back > 0) {
    const auto since = static_cast<Iteration>(frames.size()) - back;
    const std::uint64_t before = mapper.counters().replayed;
    EXPECT_TRUE(mapper.roll_back(Hint{since, 1000, 0}));
    mapper.refined_map();
    EXPECT_GE(mapper.counters().replayed - before, static_cast<std::uint64_t>(back));
  }
  return mapper.refined_map();
}

/// The farthest that a certain corner of one map is from the same one of the other.
double farthest_corner(const Map& a, const Map& b) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < a.walls.size(); ++i) {
    if (a.walls[i].certain[kEndA] && b.walls[i].certain[kEndA])
      farthest = std::max(farthest, (a.walls[i].a - b.walls[i].a).norm());
    if (a.walls[i].certain[kEndB] && b.walls[i].certain[kEndB])
      farthest = std::max(farthest, (a.walls[i].b - b.walls[i].b).norm());
  }
  return farthest;
}

TEST(RollBack, FiveHundredIterationsDoneAgainComeToTheMapOfThoseDoneOnce) {
  const Map once = mapped(0), again = mapped(500);
  ASSERT_EQ(once.walls.size(), again.walls.size());
  for (std::size_t i = 0; i < once.walls.size(); ++i) {
    EXPECT_EQ(once.walls[i].id, again.walls[i].id);
    EXPECT_EQ(once.walls[i].observations, again.walls[i].observations);
  }
  EXPECT_LT(farthest_corner(once, again), 1e-9);
}

TEST(RollBack, NoneGoesFartherBackThanTheLimit) {
  Options options;
  options.roll_back_limit = 20;
  ThesisMapper mapper(options);
  for (int i = 0; i < 40; ++i) mapper.process({}, View{});
  EXPECT_FALSE(mapper.roll_back(Hint{10, 0, 0}));
  EXPECT_TRUE(mapper.roll_back(Hint{25, 0, 0}));
  EXPECT_FALSE(mapper.roll_back(Hint{26, 0, 0})) << "one is asked for already";
}

}  // namespace
}  // namespace hallway::slam_plane::thesis::test
