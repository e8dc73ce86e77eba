// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "base/random.hpp"
#include "slam_plane/thesis/alignment.hpp"
#include "slam_plane/thesis/map_builder.hpp"
#include "slam_plane/thesis/motion_model.hpp"
#include "slam_plane/thesis/roll_back.hpp"
#include "slam_plane/thesis/steps.hpp"
#include "slam_plane/thesis/thesis_mapper.hpp"
#include "unit/slam_plane/scenes.hpp"
#include "unit/slam_plane_thesis/walls.hpp"

namespace hallway::slam_plane::thesis::test {
namespace {

using slam_plane::test::corridor_return;
using slam_plane::test::four_walls;
using slam_plane::test::observe;
using slam_plane::test::Scene;
using slam_plane::test::Sensor;
using slam_plane::test::TrueFrame;

/// What a mapper made of a scene without noise.
struct Outcome {
  double position = 0.0;  ///< largest error of a pose that was determined [m]
  double corner = 0.0;    ///< largest distance of a certain corner from the nearest true one [m]
  int lost = 0;           ///< frames without a pose
  std::size_t submaps = 0;
  std::set<LandmarkId> ids;  ///< walls that observations were taken for
  std::set<int> seen;        ///< true walls that were seen
};

double corner_error(const Map& map, const Scene& scene, const Pose2& T_map_world) {
  double worst = 0.0;
  for (const WallLandmark& wall : map.walls) {
    for (int end = 0; end < 2; ++end) {
      if (!wall.certain[end]) continue;
      double nearest = 1e9;
      for (const auto& truth : scene.walls) {
        for (const Vec2& corner : {truth.a, truth.b})
          nearest = std::min(nearest, (T_map_world * corner - (end == 0 ? wall.a : wall.b)).norm());
      }
      worst = std::max(worst, nearest);
    }
  }
  return worst;
}

Outcome run(const Scene& scene, double fov_rad) {
  Sensor sensor;
  sensor.noise_m = sensor.noise_angle_rad = sensor.noise_end_m = 0.0;
  sensor.view.horizontal_fov_rad = fov_rad;
  const std::vector<TrueFrame> frames = observe(scene, sensor, 1);
  const Pose2 T_map_world = frames.front().T_world_robot.inverse();
  ThesisMapper mapper{Options{}};
  Outcome result;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Answer& answer = mapper.process(frames[i].observations, sensor.view);
    for (const LandmarkId id : answer.associations) {
      if (id != kNoLandmark) result.ids.insert(id);
    }
    result.seen.insert(frames[i].wall.begin(), frames[i].wall.end());
    if (!answer.has_pose) ++result.lost;
    if (!answer.has_pose || answer.unobservable.norm() > 0.0) continue;
    const Pose2 truth = T_map_world * frames[i].T_world_robot;
    result.position = std::max(result.position, (answer.T_map_robot.t - truth.t).norm());
  }
  const Map map = mapper.map();
  result.submaps = map.submaps.size();
  result.corner = corner_error(map, scene, T_map_world);
  return result;
}

PlanePair pair_at(const Pose2& T, const Vec2& point, const Vec2& direction, bool same_point) {
  PlanePair pair;
  pair.point[0] = point;
  pair.point[1] = T * point;
  pair.direction[0] = direction;
  pair.direction[1] = T.rotate(direction);
  pair.same_point = same_point;
  return pair;
}

TEST(ThesisMapper, NothingSeenIsLost) {
  ThesisMapper mapper{Options{}};
  EXPECT_FALSE(mapper.process({}, View{}).has_pose);
  EXPECT_TRUE(mapper.map().walls.empty());
}

TEST(ThesisMapper, OptionsOutOfRangeAreRefused) {
  Options options;
  options.link_planes = 1;
  EXPECT_THROW(ThesisMapper{options}, std::invalid_argument);
}

TEST(ThesisMapper, SameFramesGiveTheSameBits) {
  Sensor sensor;
  sensor.view.horizontal_fov_rad = 7.0;
  ThesisMapper a{Options{}}, b{Options{}};
  for (const TrueFrame& frame : observe(four_walls(60), sensor, 3)) {
    const Answer& x = a.process(frame.observations, sensor.view);
    const Answer& y = b.process(frame.observations, sensor.view);
    EXPECT_EQ(x.T_map_robot.t, y.T_map_robot.t);
    EXPECT_EQ(x.associations, y.associations);
  }
}

TEST(ThesisMapper, FourWallsAreMappedWhereTheyWereAtFirst) {
  const Outcome result = run(four_walls(60), 7.0);
  EXPECT_LT(result.corner, 1e-3);
  EXPECT_LT(result.position, 1e-3);
  EXPECT_LE(result.lost, 20);
}

TEST(Alignment, PointsThatAreTheSameTellTheRotationAndThePlace) {
  const Pose2 truth = Pose2::at(Vec2(3, -2), 0.7);
  const std::vector<PlanePair> pairs{pair_at(truth, Vec2(4, 1), Vec2(0, -1), true),
                                     pair_at(truth, Vec2(2, -3), Vec2(1, 0), true)};
  const auto alignment = align(pairs, Pose2{});
  ASSERT_TRUE(alignment && alignment->by_points);
  EXPECT_LT((alignment->T_to_from.t - truth.t).norm(), 1e-12);
  EXPECT_LT((alignment->T_to_from.r - truth.r).norm(), 1e-12);
}

TEST(Alignment, PointsThatTellAJumpAreLeftOutWhereOthersTellNone) {
  const Pose2 truth = Pose2::at(Vec2(3, -2), 0.7), expected = Pose2::at(Vec2(3.02, -1.97), 0.65);
  PlanePair wrong = pair_at(truth, Vec2(2, -3), Vec2(1, 0), true);
  wrong.point[1] += Vec2(3.3, 0.0);
  std::vector<PlanePair> pairs{pair_at(truth, Vec2(4, 1), Vec2(0, -1), true), wrong};
  EXPECT_GT((align(pairs, expected)->T_to_from.t - truth.t).norm(), 1.0);
  leave_out_jumps(expected, 0.3, pairs);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_LT((align(pairs, expected)->T_to_from.t - truth.t).norm(), 1e-12);
  std::vector<PlanePair> alone{wrong};
  leave_out_jumps(expected, 0.3, alone);
  EXPECT_EQ(alone.size(), 1u) << "it may be right, and what was expected wrong";
}

TEST(ThesisMapper, ACorridorIsOneMapOfManySubmaps) {
  const Outcome result = run(corridor_return(), 1.5707963);
  EXPECT_GT(result.submaps, 3u);
  EXPECT_LT(result.corner, 1e-3);
}

TEST(ThesisMapper, OnTheWayBackPlanesAreFoundAgain) {
  const Outcome result = run(corridor_return(), 1.5707963);
  EXPECT_LE(static_cast<double>(result.ids.size()), 1.25 * static_cast<double>(result.seen.size()));
}

TEST(ThesisMapper, AWallAloneInViewGrowsAsTheRobotTurns) {
  // Down a corridor, past a pillar, to a wall across its end, of which the left end was seen from afar; there the robot turns, and sees it up to its right end.
  Scene scene;
  scene.walls = {{Vec2(-2, 1), Vec2(5, 1)},
                 {Vec2(5, -1), Vec2(-2, -1)},
                 {Vec2(4, 0.9), Vec2(4, 0.6)},
                 {Vec2(8, 2), Vec2(8, -6)}};
  for (int i = 0; i <= 110; ++i) scene.path.push_back(Pose2::at(Vec2(0.05 * i, 0), 0.0));
  for (int i = 1; i <= 30; ++i) scene.path.push_back(Pose2::at(Vec2(5.5, 0), -0.035 * i));
  Sensor sensor;
  sensor.noise_m = sensor.noise_angle_rad = sensor.noise_end_m = 0.0;
  sensor.view.horizontal_fov_rad = 1.0;
  ThesisMapper mapper{Options{}};
  for (const TrueFrame& frame : observe(scene, sensor, 1)) mapper.process(frame.observations, sensor.view);
  const std::vector<WallLandmark> walls = mapper.map().walls;
  const auto end_wall =
      std::find_if(walls.begin(), walls.end(), [](const WallLandmark& wall) { return wall.a.x() > 7.9; });
  ASSERT_NE(end_wall, walls.end());
  EXPECT_LT((end_wall->a - Vec2(8, 2)).norm(), 1e-6);
  EXPECT_LT((end_wall->b - Vec2(8, -6)).norm(), 1e-6);
  EXPECT_FALSE(end_wall->certain[1]);
}

TEST(Rule24, TheRobotMovesInTheDirectionInWhichItLooks) {
  // A wall at 45 degrees to the movement measures how far it went, and so where it is along the wall.
  MotionModel motion(3, 25.0);
  motion.known(Pose2{});
  Alignment seen;
  seen.open = Vec2(1, -1).normalized();
  seen.T_to_from.t = 0.05 * Vec2(1, 1).normalized();  // the place across the wall; along it nothing
  const Pose2 pose = motion.restricted(seen);
  EXPECT_NEAR(pose.t.x(), 0.05 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(pose.t.y(), 0.0, 1e-12);
}

TEST(Rule25, AWallAlongTheMovementDoesNotMeasureIt) {
  MotionModel motion(3, 25.0);
  motion.known(Pose2{});
  motion.known(Pose2::at(Vec2(0.04, 0.0), 0.0));
  Alignment seen;
  seen.open = Vec2(1.0, 0.05).normalized();
  const Vec2 across = left_of(seen.open);
  seen.T_to_from.t = Vec2(0.04, 0.0) + 0.02 * across;  // noise: taken for movement it would be 0.4 m
  EXPECT_LT((motion.restricted(seen).t - Vec2(0.04, 0.0)).norm(), 0.1);
}

TEST(Rule26, TheMotionModelIsOnAfterSomeFramesWithoutAPositionAndOffWithOne) {
  MotionModel motion(3, 25.0);
  motion.known(Pose2{});
  Alignment seen;
  seen.open = Vec2(0, 1);
  for (int i = 0; i < 3; ++i) motion.restricted(seen);
  EXPECT_FALSE(motion.active());
  motion.restricted(seen);
  EXPECT_TRUE(motion.active());
  motion.known(Pose2{});
  EXPECT_FALSE(motion.active());
}

TEST(Rule27, TheMotionModelStartsAtTheLastKnownPosition) {
  MotionModel motion(0, 25.0);
  motion.known(Pose2::at(Vec2(5, 7), 0.0));
  Alignment seen;
  seen.open = Vec2(0, 1);
  seen.T_to_from.t = Vec2(5.04, -100.0);
  const Pose2 pose = motion.restricted(seen);
  EXPECT_LT((pose.t - Vec2(5.04, 7.0)).norm(), 1e-12);
}

TEST(StepLength, IsTheMeanOfStepsThatTellPlacesWithNoise) {
  // Places 4 cm apart are measured with 2 cm: a single step tells its length to 3 cm, the mean of thirty to 1 mm.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Random random(seed, stream_id("mapper_rules_test"));
    StepLength steps;
    EXPECT_EQ(steps.mean(), 0.0);
    double last = 0.0;
    for (int i = 1; i <= 60; ++i) {
      const double place = 0.04 * i + 0.02 * random.normal(0, static_cast<std::uint64_t>(i));
      steps.add(place - last, 1.0);
      last = place;
    }
    EXPECT_NEAR(steps.mean(), 0.04, 0.004);
  }
}

TEST(StepLength, TakesNoStepFromBeforeTheRobotChangedItsSpeed) {
  StepLength steps;
  for (int i = 0; i < 20; ++i) {
    steps.add(0.04, 1.0);
    steps.add(0.02, 0.5);  // along an axis at 60 degrees
  }
  EXPECT_NEAR(steps.mean(), 0.04, 1e-12);
  for (int i = 0; i < 5; ++i) {
    steps.add(0.01, 1.0);
    EXPECT_NEAR(steps.mean(), 0.01, 1e-12);
  }
}

TEST(MotionModel, AlongAWallItGoesOnByTheMeanOfTheStepsBefore) {
  const Random random(1, stream_id("mapper_rules_test"));
  MotionModel motion(3, 25.0);
  for (int i = 0; i < 40; ++i) {
    const double noise = 0.02 * random.normal(0, static_cast<std::uint64_t>(i));
    motion.known(Pose2::at(Vec2(0.04 * i + noise, 0.0), 0.0));
  }
  Alignment seen;
  seen.open = Vec2(1, 0);
  double before = motion.pose().t.x();
  for (int i = 0; i < 10; ++i) {
    const double now = motion.restricted(seen).t.x();
    EXPECT_NEAR(now - before, 0.04, 0.004);
    before = now;
  }
}

TEST(Rule33, ARollBackLeavesNothingOfWhatCameLater) {
  const Options options;
  State state(options);
  History history(100);
  for (Iteration k = 0; k < 20; ++k) {
    history.add(k, {});
    state.now = k;
    if (k == 0 || k == 15) state.tracks.create(k);
    if (k == 12) state.submaps.emplace_back(0, k);
    for (TrackId id = 0; id < state.tracks.size(); ++id)
      state.tracks[id].push(seen(id == 0 ? kAlong : kAhead, straight(k), k));
    history.close(state);
  }
  ASSERT_TRUE(history.reaches(10));
  EXPECT_EQ(history.take_after(10).size(), 9u);
  roll_back_to(history.at(10), options, state);
  EXPECT_EQ(state.now, 10);
  ASSERT_FALSE(state.tracks.is_free(0));
  EXPECT_TRUE(state.tracks.is_free(1)) << "it began later";
  EXPECT_EQ(state.tracks[0].newest().iteration, 10);
  EXPECT_TRUE(state.submaps.empty());
}

TEST(Hints, AHintKeepsATrackFromASubmapAndDropsLaterOnes) {
  Hints hints;
  hints.add({100, 7, 2});
  EXPECT_FALSE(hints.may_join(7, 2));
  EXPECT_TRUE(hints.may_join(7, 1));
  EXPECT_TRUE(hints.may_join(8, 2));
  hints.add({50, 8, 2});  // what a later hint speaks of may not happen any more
  EXPECT_EQ(hints.size(), 1u);
  EXPECT_TRUE(hints.may_join(7, 2));
}

}  // namespace
}  // namespace hallway::slam_plane::thesis::test
