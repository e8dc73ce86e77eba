// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/long_mode.hpp"
#include "unit/slam_plane/runs.hpp"

namespace hallway::slam_plane::test {
namespace {

struct Limits {
  double corner = 1.3;    // times the yardstick's
  double position = 1.1;  // likewise
};

/// Runs a scene with several seeds and holds the pooled errors against the yardstick's. In 95 of 100 runs each wall is mapped, and none twice.
void hold(const Scene& scene, const Sensor& sensor, const Limits& limits) {
  Score ours, batch;
  const int seeds = hallway::test::sized(1, 20);
  int whole = 0;
  std::string faults;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Mapping result = run(scene, sensor, options_for(sensor), static_cast<std::uint64_t>(100 + seed));
    ours.add(result.score);
    batch.add(result.batch);
    if (result.missing == 0 && result.duplicated == 0) {
      ++whole;
    } else {
      faults += "; seed " + std::to_string(seed) + ": " + std::to_string(result.missing) + " missing, " +
                std::to_string(result.duplicated) + " twice";
    }
    EXPECT_EQ(result.wrong, 0) << scene.name << " seed " << seed;
    EXPECT_EQ(result.false_corners, 0) << scene.name << " seed " << seed;
  }
  EXPECT_GE(100 * whole, 95 * seeds) << scene.name << faults;
  EXPECT_LE(ours.corner_rmse(), limits.corner * batch.corner_rmse()) << scene.name;
  EXPECT_LE(ours.position_rmse(), limits.position * batch.position_rmse()) << scene.name;
}

Sensor sensor_of(bool occlusion, bool all_round = false) {
  Sensor sensor;
  sensor.occlusion = occlusion;
  if (all_round) sensor.view.horizontal_fov_rad = 7.0;
  return sensor;
}

TEST(Scenes, FourWallsComeToTheYardstick) {
  hold(four_walls(hallway::test::sized(250, 1000)), sensor_of(false, true), {});
}

TEST(Scenes, CorridorAndBackComesToTheYardstick) {
  hold(corridor_return(), sensor_of(false), {});
}

TEST(Scenes, CorridorLoopComesToTheYardstick) {
  hold(corridor_loop(hallway::test::sized(1, 2)), sensor_of(false), {});
}

TEST(Scenes, FeaturelessSideIsBridged) {
  hold(featureless_loop(1), sensor_of(false), {});
}

TEST(Scenes, OcclusionCostsLittle) {
  const Limits limits{2.0, 1.3};
  hold(corridor_return(), sensor_of(true), limits);
  hold(corridor_loop(hallway::test::sized(1, 2)), sensor_of(true), limits);
  hold(featureless_loop(1), sensor_of(true), limits);
}

TEST(Scenes, WithoutNoiseTheMapIsExact) {
  for (const bool occlusion : {false, true}) {
    for (const Scene& scene : {corridor_return(), corridor_loop(1), featureless_loop(1)}) {
      Sensor sensor = sensor_of(occlusion);
      sensor.noise_m = sensor.noise_angle_rad = sensor.noise_end_m = 0.0;
      const Mapping result = run(scene, sensor, Options{}, 1, false);
      EXPECT_EQ(result.missing, 0) << scene.name;
      EXPECT_LE(result.score.worst_corner, 1e-3) << scene.name;
      EXPECT_LE(result.score.position_rmse(), 1e-3) << scene.name;
    }
  }
}

/// Expects one wall to be called dynamic, and the others to be where they are: what moves is to tell nothing of anything. In one run of ten, what
/// it was before it moved may stay in the map: then it was taken for another wall when it began to move.
void expect_one_dynamic(const Scene& scene, const Sensor& sensor, double most_m) {
  const int seeds = hallway::test::sized(1, 20);
  int gone = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Mapping result =
        run(scene, sensor, options_for(sensor), static_cast<std::uint64_t>(200 + seed), false);
    const auto found =
        std::count_if(result.map.walls.begin(), result.map.walls.end(),
                      [](const WallLandmark& wall) { return wall.status == LandmarkStatus::dynamic; });
    EXPECT_EQ(found, 1) << "seed " << seed;
    EXPECT_LE(result.missing, 1) << "seed " << seed;  // the one that moves
    gone += result.missing;
    EXPECT_LE(result.score.corner_rmse(), most_m) << "seed " << seed;
  }
  EXPECT_GE(10 * gone, 9 * seeds);
}

/// A corridor with a door ahead, across it: the last wall.
Scene corridor_with_door(const Motion& motion) {
  Scene scene = corridor_loop(1);
  scene.path.resize(450);
  scene.motions.push_back(motion);
  scene.motions.back().wall = scene.walls.size();
  scene.walls.push_back({{9.0, 1.4}, {9.0, 0.6}});
  return scene;
}

TEST(Scenes, WallThatGoesAwayIsCalledDynamic) {
  expect_one_dynamic(corridor_with_door({0, 25, 100, {0.04, 0.0}, 0.0}), sensor_of(false), 0.005);
}

TEST(Scenes, DoorThatOpensIsCalledDynamic) {
  const Scene scene = corridor_with_door({0, 15, 30, Vec2::Zero(), -0.03});
  expect_one_dynamic(scene, sensor_of(false), 0.005);
  expect_one_dynamic(scene, sensor_of(true), 0.01);
}

TEST(Scenes, NothingThatStandsIsCalledDynamic) {
  for (const bool occlusion : {false, true}) {
    for (const Scene& scene : {corridor_return(), corridor_loop(1), featureless_loop(1)})
      EXPECT_EQ(
          run(scene, sensor_of(occlusion), options_for(sensor_of(occlusion)), 5, false).counters.dynamic, 0u)
          << scene.name;
  }
}

}  // namespace
}  // namespace hallway::slam_plane::test
