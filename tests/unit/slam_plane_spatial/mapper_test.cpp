// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/mapper.hpp"

#include <gtest/gtest.h>

#include "unit/slam_plane_spatial/scene.hpp"

namespace hallway::slam_plane::spatial {
namespace {

using namespace test;

TEST(SpatialMapper, OptionsOutOfRangeAreRefused) {
  Options options;
  options.noise_m = -1.0;
  EXPECT_THROW(Mapper{options}, std::invalid_argument);
}

TEST(SpatialMapper, SameFramesSameBits) {
  const Scene scene = furnished_room(60);
  const auto frames = see(scene, kNoise, 5);
  Mapper first{Options{}}, second{Options{}};
  for (const TrueFrame& frame : frames) {
    const Answer a = first.process(frame.observations, kView);
    const Answer b = second.process(frame.observations, kView);
    ASSERT_EQ(a.associations, b.associations);
    ASSERT_EQ(a.T_map_robot.t, b.T_map_robot.t);
    ASSERT_EQ(a.T_map_robot.q.coeffs(), b.T_map_robot.q.coeffs());
  }
  first.reset();
  const Answer again = first.process(frames.front().observations, kView);
  EXPECT_EQ(again.T_map_robot.t, Vec3(Vec3::Zero()));
}

TEST(SpatialMapper, WhatDoesNotDetermineThePoseIsLostAndSaysWhatIsOpen) {
  // Floor and two walls of a corridor without ends: cut at the sides and at the range of the view.
  Scene corridor{.name = "corridor", .plan = {}, .path = {}};
  const auto add = [&](const Vec3& normal, std::vector<Vec3> corners) {
    corridor.plan.faces.push_back({std::move(corners), {normal, 0.0}});
    hallway::Polygon& face = corridor.plan.faces.back();
    face.plane.offset = normal.dot(face.vertices.front());
    corridor.plan.obstacles.push_back(face);
  };
  add(Vec3::UnitZ(), {{-50, -1, 0}, {50, -1, 0}, {50, 1, 0}, {-50, 1, 0}});
  add(-Vec3::UnitY(), {{-50, 1, 0}, {50, 1, 0}, {50, 1, 3}, {-50, 1, 3}});
  add(Vec3::UnitY(), {{50, -1, 0}, {-50, -1, 0}, {-50, -1, 3}, {50, -1, 3}});
  for (int i = 0; i < 5; ++i)
    corridor.path.push_back({hallway::from_yaw_pitch_roll(0.1, 0.1, 0.1), Vec3(0.1 * i, 0, 1.4)});
  Mapper mapper{Options{}};
  for (const TrueFrame& frame : see(corridor, NoiseOf{}, 1)) {
    ASSERT_EQ(frame.observations.size(), 3u);
    const Answer& answer = mapper.process(frame.observations, kView);
    EXPECT_FALSE(answer.has_pose);
    EXPECT_EQ(answer.lost, Lost::unobservable);
    EXPECT_EQ(answer.open, 1);
    const Vec3 along = corridor.path.front().q * answer.unobservable;
    EXPECT_NEAR(std::abs(along.x()), 1.0, 1e-3);
  }
  EXPECT_TRUE(mapper.map().landmarks.empty());
}

TEST(SpatialMapper, ARobotThatSeesNothingIsLostAndGoesOn) {
  const auto frames = see(furnished_room(40), NoiseOf{}, 1);
  Mapper mapper{Options{}};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const bool blind = i >= 20 && i < 22;
    const Answer& answer =
        mapper.process(blind ? std::vector<PlaneObservation>{} : frames[i].observations, kView);
    EXPECT_EQ(answer.has_pose, !blind) << i;
    if (blind) {
      EXPECT_EQ(answer.lost, Lost::nothing_known);
    }
  }
}

}  // namespace
}  // namespace hallway::slam_plane::spatial
