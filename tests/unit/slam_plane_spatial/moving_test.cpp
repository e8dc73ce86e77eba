// SPDX-License-Identifier: MIT
// Faces that move, and robots that are carried.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "unit/slam_plane_spatial/scene.hpp"

namespace hallway::slam_plane::spatial::test {
namespace {

/// How far an answer is from the truth, if the map's frame is that of the first frame [m].
double error_of(const Answer& answer, const std::vector<TrueFrame>& frames, std::size_t frame) {
  const hallway::Pose truth = frames[0].T_world_robot.inverse() * frames[frame].T_world_robot;
  return (answer.T_map_robot.t - truth.t).norm();
}

/// One face is called dynamic, nothing that it was stays in the map, and what moves does not move the robot.
void expect_one_dynamic(std::size_t begin, const NoiseOf& noise, std::uint64_t seed, double most_m) {
  SCOPED_TRACE(testing::Message() << "from frame " << begin << ", seed " << seed);
  std::uint32_t panel = 0;
  const Scene scene = room_with_panel(90, panel);
  const auto frames = see(scene, noise, seed, {panel, begin, 30, Vec3(0.03, 0.0, 0.0)});
  Mapper mapper{Options{}};
  std::vector<LandmarkId> taken_for;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Answer& answer = mapper.process(frames[i].observations, kView);
    ASSERT_TRUE(answer.has_pose) << i;
    EXPECT_LT(error_of(answer, frames, i), most_m) << i;
    for (std::size_t k = 0; k < frames[i].truth.size(); ++k) {
      if (frames[i].truth[k] == panel && answer.associations[k] != kNoLandmark)
        taken_for.push_back(answer.associations[k]);
    }
  }
  const Map map = mapper.refined_map();
  int dynamic = 0;
  for (const PlaneLandmark& landmark : map.landmarks) {
    if (landmark.status == LandmarkStatus::dynamic) {
      ++dynamic;
      const Vec3 middle = frames[0].T_world_robot * Vec3(0.5 * (landmark.outline[0] + landmark.outline[1]));
      EXPECT_NEAR(middle.x(), 3.5 + 30 * 0.03, 4.0 * noise.plane_m + 0.02) << "where it was seen last";
      EXPECT_EQ(std::count(landmark.certain.begin(), landmark.certain.end(), true), 0);
    } else if (landmark.status == LandmarkStatus::mapped) {
      EXPECT_EQ(std::count(taken_for.begin(), taken_for.end(), landmark.id), 0) << "a place that it has left";
    }
  }
  EXPECT_EQ(dynamic, 1);
}

TEST(SpatialMoving, AFaceThatMovesIsCalledDynamic) {
  // While the map is young, what moves draws the robot by what goes unnoticed: 5 cm.
  expect_one_dynamic(0, NoiseOf{}, 1, 0.05);
  for (const std::uint64_t seed : {1u, 2u, 3u}) expect_one_dynamic(0, kNoise, seed, 0.06);
}

TEST(SpatialMoving, AFaceThatBeginsToMoveIsCalledDynamic) {
  expect_one_dynamic(15, NoiseOf{}, 1, 0.03);
  for (const std::uint64_t seed : {1u, 2u, 3u}) expect_one_dynamic(15, kNoise, seed, 0.06);
}

/// Maps a scene, sees nothing for a while, and goes on somewhere else: the number of poses told there, all of which have to be right.
int poses_after_being_carried(const Scene& scene, const NoiseOf& noise) {
  const auto frames = see(scene, noise, 1);
  Mapper mapper{Options{}};
  for (std::size_t i = 0; i < 240; ++i)
    EXPECT_TRUE(mapper.process(frames[i].observations, kView).has_pose) << i;
  for (int i = 0; i < 12; ++i) EXPECT_FALSE(mapper.process({}, kView).has_pose);
  int poses = 0;
  for (std::size_t i = 60; i < 120; ++i) {
    const Answer& answer = mapper.process(frames[i].observations, kView);
    if (!answer.has_pose) continue;
    ++poses;
    EXPECT_LT(error_of(answer, frames, i), 0.05) << i;
  }
  EXPECT_EQ(mapper.process({}, kView).counters.found_again, poses > 0 ? 1u : 0u);
  return poses;
}

TEST(SpatialMoving, ARobotThatWasCarriedIsFoundAgain) {
  EXPECT_GE(poses_after_being_carried(furnished_room(250), NoiseOf{}), 50);
  EXPECT_GE(poses_after_being_carried(furnished_room(250), kNoise), 50);
}

TEST(SpatialMoving, WhereTwoPlacesLookTheSameItStaysLost) {
  EXPECT_EQ(poses_after_being_carried(empty_room(250), NoiseOf{}), 0);
  EXPECT_EQ(poses_after_being_carried(empty_room(250), kNoise), 0);
}

}  // namespace
}  // namespace hallway::slam_plane::spatial::test
