// SPDX-License-Identifier: MIT
// FramePlacer where the prediction does not lead: turns that are searched, and places that are recognised.
#include <gtest/gtest.h>

#include <vector>

#include "placing.hpp"

namespace hallway::slam_point::placing {
namespace {

TEST(FramePlacer, ATurnThatWasNotExpectedIsSearched) {
  const std::vector<Vec3> known = room(20, 7, false);
  Sensor sensor(known);
  ASSERT_FALSE(sensor.track(known, ahead(0.2, 0.3)));
  EXPECT_FALSE(sensor.placer.search(kByTurnsAlone, sensor.frame)) << "constellations were not asked";
  EXPECT_TRUE(sensor.placer.is_placed(sensor.frame));
  sensor.expect_at(ahead(0.2, 0.3));
}

/// Whether a turn is found after so many empty frames.
bool finds_turn(double turn_rad, double max_turn_rad, int lost) {
  Options options;
  options.max_turn_rad = max_turn_rad;
  Sensor sensor(room(20, 7, false), false, options);
  for (int frame = 0; frame < lost; ++frame) sensor.lose();
  EXPECT_FALSE(sensor.track(sensor.landmarks(), ahead(0.0, turn_rad)));
  sensor.placer.search(kByTurnsAlone, sensor.frame);
  return sensor.placer.is_placed(sensor.frame);
}

TEST(FramePlacer, TurnsAreSearchedFartherTheLongerTheSensorIsLost) {
  EXPECT_TRUE(finds_turn(0.33, 0.35, 0));
  EXPECT_FALSE(finds_turn(0.6, 0.35, 0));
  EXPECT_TRUE(finds_turn(0.6, 0.35, 1));
  EXPECT_TRUE(finds_turn(3.1, 0.35, 9)) << "half a turn at most";
  EXPECT_FALSE(finds_turn(0.33, 0.0, 0)) << "not where that is not asked for";
}

TEST(FramePlacer, ATurnIsSearchedWhereTheSensorIsExpectedAndWhereItWas) {
  for (const double x : {10.5, 13.5}) {
    Options options;
    options.smoothing = 1.0;
    Sensor sensor(room(20, 1, false), false, options);
    for (const double at : {0.5, 1.5, 3.0, 5.0, 7.5, 10.5}) sensor.follow(ahead(at));
    ASSERT_FALSE(sensor.track(sensor.landmarks(), ahead(x, 0.3)));
    sensor.placer.search(kByTurnsAlone, sensor.frame);
    EXPECT_TRUE(sensor.placer.is_placed(sensor.frame));
    sensor.expect_at(ahead(x, 0.3));
  }
}

TEST(FramePlacer, WhatWasSearchedIsNotWhereTheSensorWasExpected) {
  // Three points are enough for a pose where the sensor is expected after a frame that showed what was expected.
  std::vector<Vec3> known;
  for (int i = 0; i < 8; ++i) known.emplace_back(6.0 + 2.0 * i, 0.0, 0.0);
  const std::vector<Vec3> three{{0, 7, 1}, {-5, -5, 2}, {3, -9, -3}};
  Sensor sensor(known + three);
  sensor.lose(known);
  EXPECT_TRUE(sensor.place(three, Pose{}));
  sensor.track(three, ahead(0.0, 0.3));
  sensor.placer.search(kByTurnsAlone, sensor.frame);
  EXPECT_EQ(sensor.matched(), 3u);
  EXPECT_FALSE(sensor.placer.is_placed(sensor.frame));
}

TEST(FramePlacer, AfterItWasCarriedTheSensorIsExpectedToMoveAsBefore) {
  Sensor sensor(room(30, 8, false));
  for (const double x : {0.5, 1.0, 1.5, 2.0}) sensor.follow(ahead(x));
  ASSERT_FALSE(sensor.track(sensor.landmarks(), ahead(-8.0)));
  ASSERT_TRUE(sensor.placer.search(kByPlace, sensor.frame));
  sensor.placer.accept(sensor.frame);
  EXPECT_TRUE(sensor.track(sensor.landmarks(), ahead(-7.5)));
}

TEST(FramePlacer, AFrameIsFoundByWhatItSeesWhereverTheSensorWasCarried) {
  Sensor sensor(room(30, 8, false));
  const Pose away{rotation_exp(Vec3(0.5, -2.0, 1.0)), Vec3(7, -5, 1)};
  ASSERT_FALSE(sensor.track(sensor.landmarks(), away));
  EXPECT_TRUE(sensor.placer.search(kByPlace, sensor.frame));
  EXPECT_EQ(sensor.placer.found_elsewhere().part, kNone) << "tracking goes on from there";
  EXPECT_TRUE(sensor.placer.is_placed(sensor.frame));
  sensor.expect_at(away);
  EXPECT_EQ(sensor.matched(), 30u);
}

TEST(FramePlacer, TwoPointsInAPlaneAreNoPoseWhereOneHadToBeSearched) {
  const std::vector<Vec3> known = room(20, 7, true);
  Sensor sensor(known, true);
  ASSERT_FALSE(sensor.track(first_of(known, 2) + nowhere(1, true), ahead(0.0, 0.3)));
  sensor.placer.search(kByTurnsAlone, sensor.frame);
  EXPECT_EQ(sensor.matched(), 2u);
  EXPECT_FALSE(sensor.placer.is_placed(sensor.frame));
}

/// A sensor in part 0, and another part that knows another room.
struct OtherPart : Sensor {
  OtherPart() : Sensor(room(30, 9, false)) {
    const Index active = graph.active();
    graph.deactivate();
    graph.set_part(1);
    const Index submap = graph.add_submap(Pose{});
    for (const Vec3& p : other) {
      const Index landmark = graph.add_landmark(p, 1);
      const Index member = graph.join(submap, landmark, p, true);
      graph.submaps[submap].members[member].count = 5;
      graph.resum(landmark);
    }
    places.note(graph, submap);
    for (int call = 0; call < 10; ++call) places.advance(graph);
    graph.set_part(0);
    graph.activate(active);
  }
  std::vector<Vec3> other = room(30, 10, false);
};

TEST(FramePlacer, AFrameOfAnotherPartIsToldAndNotPlaced) {
  OtherPart sensor;
  const Pose there{rotation_exp(Vec3(0.5, -2.0, 1.0)), Vec3(7, -5, 1)};
  ASSERT_FALSE(sensor.track(sensor.other, there));
  EXPECT_TRUE(sensor.placer.search(kByPlace, sensor.frame));
  const Placement found = sensor.placer.found_elsewhere();
  ASSERT_EQ(found.part, 1u);
  EXPECT_LT((found.T_map_points.t - there.t).norm(), 1e-6);
  EXPECT_FALSE(sensor.placer.is_placed(sensor.frame));
  sensor.placer.lose(sensor.frame);
  // The next frame is where the motion led: what was found is forgotten.
  EXPECT_TRUE(sensor.track(sensor.landmarks(), Pose{}));
  EXPECT_EQ(sensor.placer.found_elsewhere().part, kNone);
}

TEST(FramePlacer, AFrameOfAnotherPartIsNotPlacedThoughSomeOfItAgreesHere) {
  OtherPart sensor;
  // 13 of 30 agree where the sensor was: that would be a pose, but not a sure one.
  ASSERT_FALSE(sensor.track(first_of(sensor.landmarks(), 13) + sensor.other, Pose{}));
  EXPECT_TRUE(sensor.placer.is_placed(sensor.frame));
  EXPECT_TRUE(sensor.placer.search(kByPlace, sensor.frame));
  EXPECT_EQ(sensor.placer.found_elsewhere().part, 1u);
  EXPECT_FALSE(sensor.placer.is_placed(sensor.frame));
}

TEST(FramePlacer, GoesOnFromWhereItWasFoundElsewhere) {
  OtherPart sensor;
  const Pose there{rotation_exp(Vec3(0.5, -2.0, 1.0)), Vec3(7, -5, 1)};
  ASSERT_FALSE(sensor.track(sensor.other, there));
  sensor.placer.lose(sensor.frame);
  sensor.graph.deactivate();
  sensor.graph.set_part(1);
  // Told 0.2 m and 0.02 rad wrong: the fit to the map says where it is.
  sensor.placer.enter({rotation_exp(Vec3(0, 0, 0.02)) * there.q, there.t + Vec3(0.2, 0, 0)}, sensor.frame);
  sensor.expect_at(there);
  EXPECT_EQ(sensor.matched(), 30u);
  EXPECT_EQ(sensor.placer.frames_without_pose(), 0);
}

}  // namespace
}  // namespace hallway::slam_point::placing
