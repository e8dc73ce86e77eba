// SPDX-License-Identifier: MIT
#include "sense/point_sensor.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "base/random.hpp"
#include "sense/landmarks.hpp"
#include "sense/occluders.hpp"
#include "support/errors.hpp"
#include "unit/sense/map_text.hpp"
#include "unit/sense/sensor_fixture.hpp"

namespace hallway::sense {
namespace {

using test::camera;
using test::empty_scene;
using test::observe;
using test::seen;
using Numbers = std::vector<std::uint32_t>;

TEST(PointSensor, GivesPointsInItsOwnFrame) {
  const std::vector<Vec3> landmarks = {{8, 30, 3}};
  PointSensorSpec spec = camera();
  spec.T_body_sensor.t = Vec3(0.5, 0, 1);
  const LandmarkIndex index(landmarks);
  const PointSensor sensor(spec, index, empty_scene(), 1);
  // The body stands at (10, 20, 0) and looks along y; the sensor is half a metre ahead of it and one up.
  const auto observations =
      observe(sensor, {from_yaw_pitch_roll(0.5 * 3.14159265358979323846, 0, 0), {10, 20, 0}});
  ASSERT_EQ(observations.size(), 1u);
  EXPECT_TRUE(observations[0].point.isApprox(Vec3(9.5, 2, 2), 1e-12)) << observations[0].point.transpose();
}

TEST(PointSensor, SeesOnlyItsFieldOfView) {
  const std::vector<Vec3> landmarks = {{10, 0, 0}, {-10, 0, 0}, {10, 11, 0}, {10, 9, 0},
                                       {10, 0, 6}, {101, 0, 0}, {100, 0, 0}};
  EXPECT_EQ(seen(observe(PointSensor(camera(), LandmarkIndex(landmarks), empty_scene(), 1), Pose())),
            (Numbers{0, 3, 6}));
}

TEST(PointSensor, SeesNothingThroughAWall) {
  const std::vector<Vec3> landmarks = {{4, 0, 0}, {6, 0, 0}, {6, 4, 0}};
  trace::TriangleMesh mesh;
  mesh.add_polygon({{{5, -1, -1}, {5, 1, -1}, {5, 1, 1}, {5, -1, 1}}, {}});
  const trace::Scene scene(mesh, trace::Backend::kBruteForce);
  EXPECT_EQ(seen(observe(PointSensor(camera(), LandmarkIndex(landmarks), scene, 1), Pose())),
            (Numbers{0, 2}));
}

TEST(PointSensor, SeesAWallsPointsFromTheirOwnSideOnly) {
  const map::Document document = test::parse_map(
      test::worldspawn({{"_points_per_m2", "4"}}, {test::box_brush({5, -2, -2}, {5.1, 2, 2})}));
  const map::World world = map::build_world(document);
  const std::vector<Vec3> landmarks = make_landmarks(document, world, csg::build_surface(world));
  const trace::Scene scene(make_occluders(csg::build_surface(world)), trace::Backend::kBruteForce);
  PointSensorSpec spec = camera();
  spec.vertical_fov = spec.horizontal_fov;
  const LandmarkIndex index(landmarks);
  const PointSensor sensor(spec, index, scene, 1);
  const auto with = [&](bool (*wanted)(const Vec3&)) {
    Numbers numbers;
    for (std::uint32_t i = 0; i < landmarks.size(); ++i) {
      if (wanted(landmarks[i])) numbers.push_back(i);
    }
    return numbers;
  };
  const Numbers front = with([](const Vec3& p) { return p.x() < 5.0; });
  const Numbers back = with([](const Vec3& p) { return p.x() > 5.1; });
  EXPECT_GT(front.size(), 50u);
  EXPECT_GT(back.size(), 50u);
  EXPECT_EQ(seen(observe(sensor, Pose())), front);
  EXPECT_EQ(seen(observe(sensor, {from_yaw_pitch_roll(3.14159265358979323846, 0, 0), {10.1, 0, 0}})), back);
}

TEST(PointSensor, SeesNothingOutsideFromInsideASolid) {
  const map::Document document = test::parse_map(
      test::worldspawn({{"_points_per_m2", "4"}}, {test::box_brush({-1, -1, -1}, {1, 1, 1})}));
  const map::World world = map::build_world(document);
  const std::vector<Vec3> landmarks = make_landmarks(document, world, csg::build_surface(world));
  const trace::Scene scene(make_occluders(csg::build_surface(world)), trace::Backend::kBruteForce);
  EXPECT_TRUE(observe(PointSensor(camera(), LandmarkIndex(landmarks), scene, 1), Pose()).empty());
}

TEST(PointSensor, SeesNothingWhereThereIsNothing) {
  const std::vector<Vec3> none;
  const LandmarkIndex index(none);
  const PointSensor sensor(camera(), index, empty_scene(), 1);
  std::vector<PointObservation> observations(3);
  sensor.observe(Pose(), 0, 4, observations);
  EXPECT_TRUE(observations.empty());
}

TEST(PointSensor, RefusesAPoseThatIsNoPose) {
  const std::vector<Vec3> landmarks = {{10, 0, 0}};
  const LandmarkIndex index(landmarks);
  const PointSensor sensor(camera(), index, empty_scene(), 1);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e9}) {
    const auto error = test::error_of([&] { observe(sensor, {Quat::Identity(), {0, bad, 0}}, 7); });
    ASSERT_TRUE(error) << bad;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
    EXPECT_EQ(error->where().element, "sensor `camera`, step 7");
  }
}

TEST(PointSensor, ShufflesEveryFrameAnew) {
  std::vector<Vec3> landmarks;
  for (int i = 0; i < 100; ++i) landmarks.push_back({10, 0.1 * i - 5, 0});
  const LandmarkIndex index(landmarks);
  const PointSensor sensor(camera(), index, empty_scene(), 1);
  const auto order = [&](std::uint32_t step) {
    Numbers numbers;
    for (const auto& observation : observe(sensor, Pose(), step)) numbers.push_back(observation.landmark);
    return numbers;
  };
  EXPECT_EQ(order(0), order(0));
  EXPECT_NE(order(0), order(1));
  double mean_place_of_first_half = 0.0;
  for (std::uint32_t step = 0; step < 100; ++step) {
    const Numbers numbers = order(step);
    ASSERT_EQ(numbers.size(), 100u);
    for (std::size_t place = 0; place < 100; ++place) {
      if (numbers[place] < 50) mean_place_of_first_half += static_cast<double>(place) / 5000.0;
    }
  }
  EXPECT_NEAR(mean_place_of_first_half, 49.5, 2.0);  // the standard deviation of this mean is 0.29
}

TEST(PointSensor, IsTheSameOnAnyNumberOfThreads) {
  const Random random(9, stream_id("test"));
  std::vector<Vec3> landmarks;
  for (std::uint64_t i = 0; i < 5000; ++i) {
    landmarks.push_back({random.uniform(0, 3 * i, 0, 50), random.uniform(0, 3 * i + 1, -50, 50),
                         random.uniform(0, 3 * i + 2, -9, 9)});
  }
  trace::TriangleMesh mesh;
  mesh.add_polygon({{{20, -10, -5}, {20, 10, -5}, {20, 10, 5}, {20, -10, 5}}, {}});
  const trace::Scene scene(mesh, trace::Backend::kBruteForce);
  PointSensorSpec spec = camera();
  spec.noise_m = Vec3(0.1, 0.2, 0.3);
  const LandmarkIndex index(landmarks);
  const PointSensor sensor(spec, index, scene, 1);
  const auto one = observe(sensor, Pose(), 3, 1);
  EXPECT_GT(one.size(), 500u);
  for (const unsigned threads : {2u, 4u, 8u}) {
    const auto many = observe(sensor, Pose(), 3, threads);
    ASSERT_EQ(many.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      ASSERT_EQ(many[i].landmark, one[i].landmark);
      ASSERT_EQ(many[i].point, one[i].point);
    }
  }
}

}  // namespace
}  // namespace hallway::sense
