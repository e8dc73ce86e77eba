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
  EXPECT_TRUE(sensor.search_turn(known, ahead(0.2, 0.3)));
  EXPECT_FALSE(sensor.placement.is_recognised) << "constellations were not asked";
  sensor.expect_at(ahead(0.2, 0.3));
}

/// Whether a turn is found after so many empty frames.
bool finds_turn(double turn_rad, double max_turn_rad, int lost) {
  Options options;
  options.max_turn_rad = max_turn_rad;
  Sensor sensor(room(20, 7, false), false, options);
  for (int frame = 0; frame < lost; ++frame) sensor.lose();
  EXPECT_FALSE(sensor.track(sensor.landmarks(), ahead(0.0, turn_rad)));
  return sensor.search_turn(sensor.landmarks(), ahead(0.0, turn_rad));
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
    EXPECT_TRUE(sensor.search_turn(sensor.landmarks(), ahead(x, 0.3)));
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
  EXPECT_FALSE(sensor.search_turn(three, ahead(0.0, 0.3)));
  EXPECT_EQ(sensor.placement.associated, 3);
}

TEST(FramePlacer, AfterItWasCarriedTheSensorIsExpectedToMoveAsBefore) {
  Sensor sensor(room(30, 8, false));
  for (const double x : {0.5, 1.0, 1.5, 2.0}) sensor.follow(ahead(x));
  ASSERT_FALSE(sensor.track(sensor.landmarks(), ahead(-8.0)));
  ASSERT_TRUE(sensor.search(sensor.landmarks(), ahead(-8.0)));
  ASSERT_TRUE(sensor.placement.is_recognised);
  sensor.accept();
  EXPECT_TRUE(sensor.track(sensor.landmarks(), ahead(-7.5)));
}

TEST(FramePlacer, AFrameIsFoundByWhatItSeesWhereverTheSensorWasCarried) {
  Sensor sensor(room(30, 8, false));
  const Pose away{rotation_exp(Vec3(0.5, -2.0, 1.0)), Vec3(7, -5, 1)};
  ASSERT_FALSE(sensor.track(sensor.landmarks(), away));
  EXPECT_TRUE(sensor.search(sensor.landmarks(), away));
  EXPECT_TRUE(sensor.placement.is_recognised);
  EXPECT_EQ(sensor.placement.elsewhere.part, kNone) << "tracking goes on from there";
  sensor.expect_at(away);
  EXPECT_EQ(sensor.matched(), 30u);
}

TEST(FramePlacer, TwoPointsInAPlaneAreNoPoseWhereOneHadToBeSearched) {
  const std::vector<Vec3> known = room(20, 7, true);
  Sensor sensor(known, true);
  const std::vector<Vec3> three = first_of(known, 2) + nowhere(1, true);
  ASSERT_FALSE(sensor.track(three, ahead(0.0, 0.3)));
  EXPECT_FALSE(sensor.search_turn(three, ahead(0.0, 0.3)));
  EXPECT_EQ(sensor.placement.associated, 2);
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
    places.note(submap);
    for (int call = 0; call < 10; ++call) places.advance();
    graph.set_part(0);
    graph.activate(active);
  }
  std::vector<Vec3> other = room(30, 10, false);
};

TEST(FramePlacer, AFrameOfAnotherPartIsToldAndNotPlaced) {
  OtherPart sensor;
  const Pose there{rotation_exp(Vec3(0.5, -2.0, 1.0)), Vec3(7, -5, 1)};
  ASSERT_FALSE(sensor.track(sensor.other, there));
  EXPECT_FALSE(sensor.search(sensor.other, there));
  EXPECT_TRUE(sensor.placement.is_recognised);
  const Relocalisation found = sensor.placement.elsewhere;
  ASSERT_EQ(found.part, 1u);
  EXPECT_LT((found.T_map_points.t - there.t).norm(), 1e-6);
  sensor.tracking.learn(sensor.placement);
  // The next frame is where the motion led: what was found is forgotten.
  EXPECT_TRUE(sensor.track(sensor.landmarks(), Pose{}));
  EXPECT_EQ(sensor.placement.elsewhere.part, kNone);
}

TEST(FramePlacer, AFrameOfAnotherPartIsNotPlacedThoughSomeOfItAgreesHere) {
  OtherPart sensor;
  // 13 of 30 agree where the sensor was: that would be a pose, but not a sure one.
  const std::vector<Vec3> both = first_of(sensor.landmarks(), 13) + sensor.other;
  ASSERT_FALSE(sensor.track(both, Pose{}));
  EXPECT_TRUE(sensor.placement.has_pose);
  EXPECT_FALSE(sensor.search(both, Pose{}));
  EXPECT_TRUE(sensor.placement.is_recognised);
  EXPECT_EQ(sensor.placement.elsewhere.part, 1u);
}

TEST(FramePlacer, GoesOnFromWhereItWasFoundElsewhere) {
  OtherPart sensor;
  const Pose there{rotation_exp(Vec3(0.5, -2.0, 1.0)), Vec3(7, -5, 1)};
  sensor.lose(sensor.other, there);
  sensor.graph.deactivate();
  sensor.graph.set_part(1);
  // Told 0.2 m and 0.02 rad wrong: the fit to the map says where it is.
  sensor.placement = sensor.placer.place_at(
      {rotation_exp(Vec3(0, 0, 0.02)) * there.q, there.t + Vec3(0.2, 0, 0)}, sensor.frame);
  sensor.expect_at(there);
  EXPECT_EQ(sensor.matched(), 30u);
  EXPECT_TRUE(sensor.placement.has_pose);
  sensor.tracking.enter(Pose{}, sensor.matched());
  EXPECT_EQ(sensor.tracking.frames_without_pose(), 0);
}

}  // namespace
}  // namespace hallway::slam_point::placing
