// SPDX-License-Identifier: MIT
#include "foxglove/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hallway::foxglove {
namespace {

bool same(const Colour& a, const Colour& b) {
  return a.red == b.red && a.green == b.green && a.blue == b.blue;
}

std::vector<log::MapLandmark> landmarks_of_each_status() {
  return {{.id = 5, .position_m = {1, 2, 3}, .status = log::LandmarkStatus::kMapped},
          {.id = 6, .position_m = {4, 2, 3}, .status = log::LandmarkStatus::kTemporary},
          {.id = 7, .position_m = {7, 2, 3}, .status = log::LandmarkStatus::kDynamic},
          {.id = 8, .position_m = {1, 2, 9}, .status = log::LandmarkStatus::kMapped}};
}

TEST(FoxgloveScenes, ALandmarksColourIsItsStatus) {
  const auto landmarks = landmarks_of_each_status();
  const Entity entity = landmark_balls(landmarks);
  EXPECT_EQ(entity.frame, "map");
  ASSERT_EQ(entity.balls.size(), landmarks.size());
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    for (std::size_t k = 0; k < landmarks.size(); ++k) {
      EXPECT_EQ(same(entity.balls[i].colour, entity.balls[k].colour),
                landmarks[i].status == landmarks[k].status);
    }
    EXPECT_EQ(entity.balls[i].centre.x(), landmarks[i].position_m[0]);
    EXPECT_EQ(entity.balls[i].centre.z(), landmarks[i].position_m[2]);
  }
}

TEST(FoxgloveScenes, ABodyHasTheEdgesOfAPrism) {
  const std::vector<Vec2> corners{{0.2, -0.1}, {0.2, 0.1}, {-0.3, 0.0}};
  const Entity entity = robot_body(corners, 0.05, 0.4);
  EXPECT_EQ(entity.frame, "body_truth");
  ASSERT_EQ(entity.lines.size(), 1u);
  EXPECT_EQ(entity.lines[0].kind, Line::Kind::kPairs);
  EXPECT_EQ(entity.lines[0].points.size(), 18u) << "nine edges";
  for (const Vec3& point : entity.lines[0].points) {
    EXPECT_TRUE(point.z() == 0.05 || point.z() == 0.4);
    EXPECT_NE(std::ranges::find(corners, Vec2(point.head<2>())), corners.end());
  }
}

TEST(FoxgloveScenes, ACommandIsTheWayAndTheTurnOfOneSecond) {
  EXPECT_TRUE(command_arrow({}).lines.empty());
  const Entity both = command_arrow({.linear_m_s = 0.5, .angular_rad_s = -0.7, .lateral_m_s = 0.25});
  EXPECT_EQ(both.frame, "body_truth");
  ASSERT_EQ(both.lines.size(), 2u);
  EXPECT_EQ(both.lines[0].points[0], Vec3(0, 0, 0));
  EXPECT_EQ(both.lines[0].points[1], Vec3(0.5, 0.25, 0));
  const Vec3 end = both.lines[1].points.back();
  EXPECT_NEAR(std::atan2(end.y(), end.x()), -0.7, 1e-12);
}

TEST(FoxgloveScenes, EachContactIsAnEntityOfItsOwn) {
  const log::ContactRow contact{.kind = "wall", .position_m = {1, 2, 3}};
  EXPECT_EQ(contact_ball(contact, 0).frame, "world");
  EXPECT_EQ(contact_ball(contact, 0).balls.at(0).centre, Vec3(1, 2, 3));
  EXPECT_NE(contact_ball(contact, 0).id, contact_ball(contact, 1).id);
}

TEST(FoxgloveScenes, BallsGrowWithTheExtent) {
  const auto diameter = [](double extent_m) {
    const std::vector<log::Landmark> landmarks{{.id = 0, .position_m = {0, 0, 0}},
                                               {.id = 1, .position_m = {0, extent_m, 0}}};
    return true_landmark_balls(landmarks).balls.front().diameter_m;
  };
  EXPECT_EQ(diameter(0), diameter(1)) << "seen at all";
  EXPECT_LT(diameter(10), diameter(100));
  EXPECT_LE(diameter(1e9), 2.0);
  EXPECT_TRUE(true_landmark_balls({}).balls.empty());
  EXPECT_EQ(true_landmark_balls({}).frame, "world");
}

TEST(FoxgloveScenes, ASubmapJoinsItsMappedLandmarksToTheirMiddle) {
  const auto landmarks = landmarks_of_each_status();
  const std::vector<log::IdPair> members{{2, 8}, {1, 5}, {1, 6}, {2, 5}, {1, 99}};
  const Entity entity = submap_stars({.landmarks = landmarks, .submap_members = members});
  EXPECT_EQ(entity.frame, "map");
  ASSERT_EQ(entity.lines.size(), 2u);
  ASSERT_EQ(entity.lines[0].points.size(), 2u) << "6 is not mapped, 99 is not there";
  EXPECT_EQ(entity.lines[0].points[1], Vec3(1, 2, 3));
  ASSERT_EQ(entity.lines[1].points.size(), 4u);
  EXPECT_EQ(entity.lines[1].points[0], Vec3(1, 2, 6));
  EXPECT_EQ(entity.lines[1].points[1], Vec3(1, 2, 9));
  EXPECT_EQ(entity.lines[1].points[2], Vec3(1, 2, 6));
  EXPECT_EQ(entity.lines[1].points[3], Vec3(1, 2, 3));
  EXPECT_EQ(entity.lines[1].kind, Line::Kind::kPairs);
  EXPECT_FALSE(same(entity.lines[0].colour, entity.lines[1].colour));
}

log::PlaneLandmark square(log::LandmarkId id, double x) {
  return {.id = id,
          .normal = {-1, 0, 0},
          .offset_m = -x,
          .outline = {{{x, 1, 0}, false}, {{x, -1, 0}, true}, {{x, -1, 2}, false}, {{x, 1, 2}, false}}};
}

TEST(FoxgloveScenes, CertainEdgesOfAMappedPlaneAreWider) {
  const Entity entity = mapped_plane_outlines(std::vector{square(3, 5)});
  EXPECT_EQ(entity.frame, "map");
  ASSERT_EQ(entity.lines.size(), 2u);
  EXPECT_EQ(entity.lines[0].points.size(), 6u);
  ASSERT_EQ(entity.lines[1].points.size(), 2u);
  EXPECT_EQ(entity.lines[1].points[0], Vec3(5, -1, 0));
  EXPECT_EQ(entity.lines[1].points[1], Vec3(5, -1, 2));
  EXPECT_GT(entity.lines[1].width_px, entity.lines[0].width_px);
}

TEST(FoxgloveScenes, ASubmapJoinsItsPlanesToItsOrigin) {
  const Entity entity = submap_stars({.planes = {square(3, 5), square(4, 7)},
                                      .submaps = {{.id = 9, .position_m = {0.5, 0, 0}}},
                                      .submap_members = {{9, 3}, {9, 4}}});
  ASSERT_EQ(entity.lines.size(), 1u);
  ASSERT_EQ(entity.lines[0].points.size(), 4u);
  EXPECT_EQ(entity.lines[0].points[0], Vec3(0.5, 0, 0));
  EXPECT_EQ(entity.lines[0].points[1], Vec3(5, 0, 1));
  EXPECT_EQ(entity.lines[0].points[3], Vec3(7, 0, 1));
}

}  // namespace
}  // namespace hallway::foxglove
