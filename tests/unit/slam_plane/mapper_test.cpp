// SPDX-License-Identifier: MIT
#include "slam_plane/core/mapper.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "unit/slam_plane/runs.hpp"

namespace hallway::slam_plane::test {
namespace {

TEST(Mapper, NothingSeenIsLostAndStartsNothing) {
  Mapper mapper{Options{}};
  const Answer& answer = mapper.process({}, View{});
  EXPECT_FALSE(answer.has_pose);
  EXPECT_EQ(answer.lost, Lost::nothing_seen);
  EXPECT_TRUE(mapper.map().walls.empty());
}

TEST(Mapper, PiecesThatAreNoneAreSkipped) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<WallObservation> bad{{{nan, 1}, {5, -1}, 0, 2},
                                         {{5, inf}, {5, -1}, 0, 2},
                                         {{5, -1}, {5, 1}, 0, 2},
                                         {{1e7, 1}, {5, -1}, 0, 2},
                                         {{5, 1}, {5, 1}, 0, 2}};
  Mapper mapper{Options{}};
  const Answer& answer = mapper.process(bad, View{});
  EXPECT_FALSE(answer.has_pose);
  for (const LandmarkId id : answer.associations) EXPECT_EQ(id, kNoLandmark);
}

TEST(Mapper, OneWallTellsWhichDirectionIsOpen) {
  Mapper mapper{Options{}};
  const std::vector<WallObservation> one{{{5, 5}, {5, -5}, 0, 2.5}};
  mapper.process(one, View{});
  const Answer& answer = mapper.process(one, View{});
  ASSERT_TRUE(answer.has_pose);
  EXPECT_NEAR(std::abs(answer.unobservable.y()), 1.0, 1e-6);
  EXPECT_GT(answer.covariance(1, 1), 0.5);
  EXPECT_LT(answer.covariance(0, 0), 0.01);
}

TEST(Mapper, OptionsOutOfRangeAreRefused) {
  Options options;
  options.noise_m = 0.0;
  EXPECT_THROW(Mapper{options}, std::invalid_argument);
}

TEST(Mapper, SameFramesGiveTheSameBits) {
  const Scene scene = four_walls(60);
  Sensor sensor;
  sensor.view.horizontal_fov_rad = 7.0;
  const auto frames = observe(scene, sensor, 1);
  Mapper a{Options{}}, b{Options{}};
  for (const TrueFrame& frame : frames) {
    const Answer& x = a.process(frame.observations, sensor.view);
    const Answer& y = b.process(frame.observations, sensor.view);
    EXPECT_EQ(x.T_map_robot.t, y.T_map_robot.t);
    EXPECT_EQ(x.associations, y.associations);
  }
  b.reset();
  EXPECT_TRUE(b.map().walls.empty());
  b.process(frames[0].observations, sensor.view);
  EXPECT_EQ(b.map().walls.size(), 4u);
}

TEST(Mapper, OrderOfPiecesSaysNothing) {
  const Scene scene = four_walls(40);
  Sensor sensor;
  sensor.view.horizontal_fov_rad = 7.0;
  Mapper a{Options{}}, b{Options{}};
  for (const TrueFrame& frame : observe(scene, sensor, 2)) {
    std::vector<WallObservation> reversed(frame.observations.rbegin(), frame.observations.rend());
    const Pose2 T = a.process(frame.observations, sensor.view).T_map_robot;
    EXPECT_NEAR((b.process(reversed, sensor.view).T_map_robot.t - T.t).norm(), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace hallway::slam_plane::test
