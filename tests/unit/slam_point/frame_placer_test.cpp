// SPDX-License-Identifier: MIT
#include "slam_point/core/frame/frame_placer.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <vector>

#include "placing.hpp"
#include "support/dense.hpp"

namespace hallway::slam_point::placing {
namespace {

// ---- Where the frame is looked for

TEST(FramePlacer, AFrameNearThePredictionIsFollowedAndOneBeyondTheBoundIsNot) {
  Sensor sensor(room(20, 1, false));
  EXPECT_TRUE(sensor.track(sensor.landmarks(), ahead(0.55)));
  sensor.expect_at(ahead(0.55));
  EXPECT_EQ(sensor.matched(), 20u);
  EXPECT_FALSE(sensor.track(sensor.landmarks(), ahead(0.65))) << "12 noise_m are 0.6 m";
}

TEST(FramePlacer, TheSensorIsExpectedToMoveAsItMovedLast) {
  Sensor sensor(room(20, 1, false));
  for (const double x : {0.5, 1.3, 2.3, 3.3}) sensor.follow(ahead(x));
  EXPECT_TRUE(sensor.track(sensor.landmarks(), ahead(4.3)));
  sensor.expect_at(ahead(4.3));
  EXPECT_FALSE(sensor.track(sensor.landmarks(), ahead(3.3))) << "it stopped within a frame";
}

TEST(FramePlacer, FramesWithoutAPoseAreBridgedAsLongAsItIsSaid) {
  const auto found_at = [](int bridge_frames, int lost, double x) {
    Options options;
    options.bridge_frames = bridge_frames;
    Sensor sensor(room(20, 1, false), false, options);
    for (const double at : {0.5, 1.0, 1.5, 2.0}) sensor.follow(ahead(at));  // predicted to 2 cm a frame
    for (int frame = 0; frame < lost; ++frame) sensor.lose();
    EXPECT_EQ(sensor.tracking.frames_without_pose(), lost);
    return sensor.place(sensor.landmarks(), ahead(x));
  };
  EXPECT_TRUE(found_at(10, 4, 4.5));
  EXPECT_TRUE(found_at(2, 4, 3.5)) << "two frames and this one";
  EXPECT_FALSE(found_at(2, 4, 4.5));
}

TEST(FramePlacer, WhatItMovedOverALossIsSharedAmongTheFrames) {
  Sensor sensor(room(20, 1, false));
  for (const double x : {0.5, 1.0, 1.5, 2.0}) sensor.follow(ahead(x));
  for (int frame = 0; frame < 3; ++frame) sensor.lose();
  sensor.follow(ahead(4.0));
  EXPECT_TRUE(sensor.track(sensor.landmarks(), ahead(4.5)));
}

TEST(FramePlacer, AFrameIsSureWhenHalfOfThePointsAgreeAndOfFewAllDo) {
  for (const bool planar : {false, true}) {
    const std::vector<Vec3> known = room(20, 2, planar);
    Sensor sensor(known, planar);
    EXPECT_TRUE(sensor.track(first_of(known, 5), ahead(0.1)));
    EXPECT_FALSE(sensor.track(first_of(known, 4) + nowhere(1, planar), ahead(0.1)));
    EXPECT_TRUE(sensor.track(first_of(known, 6) + nowhere(6, planar), ahead(0.1)));
    EXPECT_FALSE(sensor.track(first_of(known, 6) + nowhere(7, planar), ahead(0.1)));
    // Of more points than the last frame saw, so many count.
    EXPECT_TRUE(sensor.track(first_of(known, 10) + nowhere(50, planar), ahead(0.1)));
    EXPECT_FALSE(sensor.track(first_of(known, 9) + nowhere(50, planar), ahead(0.1)));
  }
}

// ---- Whether it has a pose

TEST(FramePlacer, ThreePointsInSpaceMakeAPose) {
  const std::vector<Vec3> known = room(20, 3, false);
  Sensor sensor(known);
  EXPECT_TRUE(sensor.place(first_of(known, 3), ahead(0.1)));
  EXPECT_FALSE(sensor.place(first_of(known, 2), ahead(0.1)));
  EXPECT_FALSE(sensor.place(first_of(known, 2) + nowhere(1, false), ahead(0.1)));
}

TEST(FramePlacer, InSpaceTwoOfThreePointsMakeNone) {
  // The third one lies half a metre aside, out of the plane of the others and the sensor: no turn makes up for that.
  const std::vector<Vec3> known{{8, 0, 0}, {8, 4, 0}, {8, -4, 0}, {0, 9, 1}, {0, -9, 2}};
  Sensor sensor(known);
  EXPECT_TRUE(sensor.place({{8, 0, 0}, {8, 4, 0}, {0, 9, 1}}, Pose{}));
  EXPECT_FALSE(sensor.place({{8, 0, 0}, {8, 4, 0}, {0.57, 9, 1}}, Pose{}));
}

TEST(FramePlacer, TwoPointsInAPlaneMakeAPoseWhereAThirdIsInView) {
  const std::vector<Vec3> known = room(20, 3, true);
  Sensor sensor(known, true);
  EXPECT_TRUE(sensor.place(first_of(known, 3), ahead(0.1)));
  EXPECT_TRUE(sensor.place(first_of(known, 2) + nowhere(1, true), ahead(0.1)));
  EXPECT_FALSE(sensor.place(first_of(known, 2), ahead(0.1))) << "nothing checks them";
  EXPECT_FALSE(sensor.place(first_of(known, 1) + nowhere(2, true), ahead(0.1)));
}

TEST(FramePlacer, TwoFifthsOfThePointsHaveToAgree) {
  for (const bool planar : {false, true}) {
    const std::vector<Vec3> known = room(20, 4, planar);
    Sensor sensor(known, planar);
    EXPECT_TRUE(sensor.place(first_of(known, 4) + nowhere(6, planar), ahead(0.1)));
    EXPECT_FALSE(sensor.place(first_of(known, 4) + nowhere(7, planar), ahead(0.1)));
    EXPECT_TRUE(sensor.place(first_of(known, 8) + nowhere(50, planar), ahead(0.1)))
        << "of the 20 seen before";
    EXPECT_FALSE(sensor.place(first_of(known, 7) + nowhere(50, planar), ahead(0.1)));
  }
}

/// How many points have to agree after so many empty frames, where chance is no question: landmarks are few and far between.
std::size_t least_after_loss(int lost) {
  Options options;
  options.map_bound_m = 4.0;
  std::vector<Vec3> known = room(20, 5, false);
  for (Vec3& p : known) p *= 5.0;
  for (std::size_t points = 1; points < known.size(); ++points) {
    Sensor sensor(known, false, options);
    for (int frame = 0; frame < lost; ++frame) sensor.lose();
    if (sensor.place(first_of(known, points), Pose{})) return points;
  }
  return known.size();
}

TEST(FramePlacer, AfterFramesWithoutAPoseMorePointsHaveToAgree) {
  EXPECT_EQ(least_after_loss(0), 3u);
  EXPECT_EQ(least_after_loss(1), 4u);
  EXPECT_EQ(least_after_loss(3), 4u);
  EXPECT_EQ(least_after_loss(4), 5u);
}

TEST(FramePlacer, WhatMayAgreeByChanceIsNoPoseWhereTheSensorIsNotExpected) {
  // Four points within a bound of 16 noise_m may; five may not.
  const std::vector<Vec3> known = room(20, 5, false);
  Sensor sensor(known);
  EXPECT_TRUE(sensor.place(first_of(known, 4), Pose{}));
  sensor.lose();
  EXPECT_FALSE(sensor.place(first_of(known, 4), Pose{}));
  EXPECT_TRUE(sensor.place(first_of(known, 5), Pose{}));
}

/// Eight points on a line, and six others that are not.
std::vector<Vec3> line_and_others() {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.emplace_back(6.0 + 2.0 * i, 0.0, 0.0);
  return points + std::vector<Vec3>{{0, 7, 1}, {-5, -5, 2}, {3, -9, -3}, {9, 6, 3}, {-4, 8, 0}, {5, -6, 4}};
}

TEST(FramePlacer, AFrameThatShowsWhatIsExpectedDoesNotTellThatTheSensorIsElsewhere) {
  const std::vector<Vec3> known = line_and_others();
  const std::vector<Vec3> line = first_of(known, 8);
  const std::vector<Vec3> three(known.begin() + 8, known.begin() + 11);
  const auto placed_after = [&](const std::vector<std::vector<Vec3>>& frames) {
    Sensor sensor(known);
    for (const std::vector<Vec3>& points : frames) sensor.lose(points);
    return sensor.place(three, Pose{});
  };
  EXPECT_TRUE(placed_after({line}));
  EXPECT_TRUE(placed_after({line, line, line}));
  EXPECT_FALSE(placed_after({line, line, line, line})) << "too long";
  EXPECT_FALSE(placed_after({{}})) << "nothing of what was expected";
  EXPECT_FALSE(placed_after({first_of(line, 5)})) << "too little of it";
  EXPECT_TRUE(placed_after({first_of(line, 6)}));
  EXPECT_FALSE(placed_after({first_of(line, 6) + nowhere(9, false)})) << "6 of the 14 seen before";
  EXPECT_FALSE(placed_after({{}, line})) << "what was contradicted once";
}

/// A sensor whose map is of long ago: landmarks may lie elsewhere, as far as the map bound.
struct OnOldGround : Sensor {
  explicit OnOldGround(const std::vector<Vec3>& known) : Sensor(known, false, short_memory()) {
    for (int more = 0; more < 2; ++more) {
      graph.deactivate();
      submaps.open_new(Pose{});
    }
  }
  static Options short_memory() {
    Options options;
    options.window = 1;
    return options;
  }
};

TEST(FramePlacer, AFrameThatFitsAndDoesNotAgreeTellsThatTheSensorIsElsewhere) {
  const std::vector<Vec3> known = room(20, 11, false);
  std::vector<Vec3> shaken = known;
  for (std::size_t i = 0; i < shaken.size(); ++i)
    shaken[i][static_cast<Eigen::Index>(i % 3)] += i % 2 == 0 ? 0.6 : -0.6;  // six ways
  OnOldGround undisturbed(known);
  EXPECT_TRUE(undisturbed.place(first_of(known, 3), Pose{}));
  OnOldGround sensor(known);
  sensor.lose(shaken);
  EXPECT_EQ(sensor.placement.associated, 20);
  EXPECT_FALSE(sensor.place(first_of(known, 3), Pose{}));
}

TEST(FramePlacer, APoseMakesGoodWhatWasContradictedBefore) {
  const std::vector<Vec3> known = line_and_others();
  Sensor sensor(known);
  sensor.lose();
  sensor.follow(Pose{});
  EXPECT_EQ(sensor.tracking.frames_without_pose(), 0);
  sensor.lose(first_of(known, 8));
  EXPECT_TRUE(sensor.place({known.begin() + 8, known.begin() + 11}, Pose{}));
}

// ---- Without a pose

TEST(FramePlacer, TellsWhatAFrameWithoutAPoseDeterminesAllTheSame) {
  for (const bool planar : {false, true}) {
    const std::vector<Vec3> known = room(20, 6, planar);
    const auto determined = [&](std::size_t points, int lost_before = 0) {
      Sensor sensor(known, planar);
      for (int frame = 0; frame < lost_before; ++frame) sensor.lose();
      return sensor.lose(first_of(known, points));
    };
    EXPECT_EQ(determined(0), 0);
    EXPECT_EQ(determined(1), planar ? 2 : 3);
    EXPECT_EQ(determined(1, 9), planar ? 2 : 3);
    EXPECT_EQ(determined(1, 10), 0) << "what was expected so long ago tells nothing";
  }
  const std::vector<Vec3> line = first_of(line_and_others(), 8);
  EXPECT_EQ(Sensor(line_and_others()).lose(first_of(line, 2)), 5);
  EXPECT_EQ(Sensor(line_and_others()).lose(line), 5);
  // No fit says better where the sensor is: points are looked for as far from the prediction as it may err.
  EXPECT_EQ(Sensor(line_and_others()).lose(line, ahead(0.55)), 5);
  EXPECT_EQ(Sensor(line_and_others()).lose(line, ahead(0.65)), 0);
}

TEST(FramePlacer, WhatFitsAndDoesNotAgreeDeterminesNothing) {
  const std::vector<Vec3> known = room(20, 6, false);
  Sensor sensor(known);
  // Four of eleven agree: a pose is fitted, and not believed.
  EXPECT_EQ(sensor.lose(first_of(known, 4) + nowhere(7, false)), 0);
}

TEST(FramePlacer, AFrameWithoutAPoseIsUnmatched) {
  const std::vector<Vec3> known = room(20, 6, false);
  Sensor sensor(known);
  sensor.lose(first_of(known, 4) + nowhere(7, false));
  ASSERT_EQ(sensor.placement.associated, 4);
  EXPECT_EQ(sensor.matched(), 0u);
  EXPECT_EQ(sensor.tracking.frames_without_pose(), 1);
}

// ---- What the placed frame leaves behind

TEST(FramePlacer, AnOutlierOfOldGroundIsUnassociatedInAPlacedFrame) {
  const std::vector<Vec3> known = room(20, 11, false);
  OnOldGround sensor(known);
  std::vector<Vec3> seen = known;
  seen[7].z() += 0.5;  // beyond six noise_m, within the map bound
  // It was matched: of the points alone, it has the landmark.
  Observations alone{{seen[7], 0}};
  sensor.matcher.mark({});
  sensor.matcher.match_map(Pose{}, sensor.submaps.local_since(), 0.3, alone);
  EXPECT_EQ(alone[0].landmark, 7u);
  ASSERT_TRUE(sensor.place(seen, Pose{}));
  EXPECT_EQ(sensor.frame.observations[7].landmark, kNone);
  EXPECT_EQ(sensor.matched(), 19u);
}

TEST(FramePlacer, LiesInTheSubmapAsItLiesInTheMap) {
  Sensor sensor(room(20, 12, false));
  const Pose here{rotation_exp(Vec3(0.01, 0.02, -0.02)), Vec3(0.3, 0.1, 0.1)};
  sensor.graph.poses[0] = {rotation_exp(Vec3(0, 0, 1)), Vec3(3, 4, 5)};
  std::vector<Index> all(20);
  for (Index l = 0; l < 20; ++l) all[l] = l;
  sensor.graph.take_moved(all);
  ASSERT_TRUE(sensor.place(sensor.landmarks(), here));
  EXPECT_LT((sensor.placement.T_submap_sensor.t - here.t).norm(), 1e-9);
  sensor.expect_at(sensor.graph.poses[0] * here);
}

TEST(FramePlacer, WhereTheActiveSubmapKnowsNothingTheMapTellsWhereTheFrameIs) {
  OnOldGround sensor(room(20, 11, false));
  ASSERT_TRUE(sensor.place(sensor.landmarks(), ahead(0.3)));
  sensor.expect_at(ahead(0.3));
  EXPECT_LT((sensor.placement.T_submap_sensor.t - Vec3(0.3, 0, 0)).norm(), 1e-9);
}

TEST(FramePlacer, FollowsTheMapWhenThatMoves) {
  Sensor sensor(room(20, 12, false));
  sensor.follow(ahead(0.4));
  const Pose moved{rotation_exp(Vec3(0.0, 0.01, 0.02)), Vec3(0.1, -0.2, 0.05)};
  for (Pose& pose : sensor.graph.poses) pose = moved * pose;
  std::vector<Index> all(20);
  for (Index l = 0; l < 20; ++l) all[l] = l;
  sensor.graph.take_moved(all);
  sensor.matcher.fit_map(sensor.frame.observations, sensor.placement.T_map_sensor);
  sensor.expect_at(moved * ahead(0.4));
}

TEST(FramePlacer, InAnotherSubmapItIsExpectedWhereItIsSaidToBe) {
  Sensor sensor(room(20, 13, false));
  for (const double x : {0.5, 1.3, 2.3, 3.3}) sensor.follow(ahead(x));
  // The same place in a submap that begins here; the motion goes on.
  sensor.graph.deactivate();
  sensor.submaps.open_new(ahead(3.3));
  sensor.placement.T_submap_sensor = Pose{};
  sensor.integrate();
  EXPECT_TRUE(sensor.track(sensor.landmarks(), ahead(4.3)));
  sensor.expect_at(ahead(4.3));
  EXPECT_LT((sensor.placement.T_submap_sensor.t - Vec3(1, 0, 0)).norm(), 1e-9);
}

// ---- Against slow ones, and again

TEST(FramePlacer, ThePoseIsTheLeastSquaresFitToTheLandmarks) {
  // All landmarks are seen as often, so all count alike, and the closed form needs no weights.
  const std::vector<Vec3> known = room(25, 14, false);
  Sensor sensor(known);
  scenes::Random random(15);
  for (int step = 1; step <= 50; ++step) {
    sensor.see(known, ahead(0.1 * step, 0.02 * step));
    Eigen::Matrix3Xd from(3, 25), to(3, 25);
    for (std::size_t i = 0; i < known.size(); ++i) {
      Observation& seen = sensor.frame.observations[i];
      seen.point += 0.02 * Vec3(random.normal(), random.normal(), random.normal());
      from.col(static_cast<Eigen::Index>(i)) = seen.point;
      to.col(static_cast<Eigen::Index>(i)) = sensor.graph.landmarks[i].position;
    }
    ASSERT_TRUE(sensor.place());
    ASSERT_TRUE(sensor.placement.is_sure);
    const Eigen::Matrix4d expected = dense::rigid_motion(from, to);
    const Pose& T = sensor.placement.T_map_sensor;
    EXPECT_LT((T.t - expected.topRightCorner<3, 1>()).norm(), 1e-9);
    EXPECT_LT((T.q.toRotationMatrix() - expected.topLeftCorner<3, 3>()).norm(), 1e-9);
    for (Index i = 0; i < known.size(); ++i) EXPECT_EQ(sensor.frame.observations[i].landmark, i);
    sensor.accept();
    sensor.integrate();
  }
}

TEST(FramePlacer, GivesTheSameBitsEveryTime) {
  const auto path = [] {
    const std::vector<Vec3> known = room(30, 16, false);
    Sensor sensor(known);
    scenes::Random random(17);
    std::vector<Vec3> places;
    for (int step = 1; step <= 60; ++step) {
      const double jump = step % 20 == 0 ? 0.3 : 0.0;
      sensor.see(step % 7 == 0 ? nowhere(8, false) : known, ahead(0.1 * step, 0.02 * step + jump));
      for (Observation& observation : sensor.frame.observations)
        observation.point += 0.05 * Vec3(random.normal(), random.normal(), random.normal());
      sensor.frame.followed = false;
      sensor.placement = sensor.placer.place(sensor.frame);
      sensor.tracking.learn(sensor.placement);
      if (sensor.placement.has_pose) sensor.integrate();
      places.push_back(sensor.placement.T_map_sensor.t);
      places.push_back(sensor.placement.T_map_sensor.q.vec());
    }
    return places;
  };
  EXPECT_EQ(path(), path());
}

}  // namespace
}  // namespace hallway::slam_point::placing
