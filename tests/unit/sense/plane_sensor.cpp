// SPDX-License-Identifier: MIT
#include "sense/plane_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/errors.hpp"
#include "unit/sense/plane_fixture.hpp"

namespace hallway::sense {
namespace {

using test::box_walls;
using test::observe;
using test::plan_of;
using test::plane_camera;
using test::reaches;
using test::seen_of;
using test::standing;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

std::vector<std::uint32_t> walls_of(const std::vector<PlaneObservation>& planes) {
  std::vector<std::uint32_t> walls;
  for (const PlaneObservation& plane : planes) walls.push_back(plane.true_plane);
  return walls;
}
using Walls = std::vector<std::uint32_t>;

TEST(PlaneSensor, GivesAWallAsARectangleThatFacesIt) {
  const auto planes = seen_of(plane_camera(), plan_of({{{5, 2}, {5, -2}}}));
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_EQ(planes[0].true_plane, 0u);
  EXPECT_EQ(planes[0].plane.normal, Vec3(-1, 0, 0));
  EXPECT_EQ(planes[0].plane.offset, -5.0);
  EXPECT_EQ(planes[0].centroid, Vec3(5, 0, 0.5));
  EXPECT_EQ(planes[0].corners,
            (std::array<Vec3, 4>{Vec3(5, 2, -1), Vec3(5, -2, -1), Vec3(5, -2, 2), Vec3(5, 2, 2)}));
}

TEST(PlaneSensor, GivesItInItsOwnFrame) {
  // The body stands at (10, 20) and looks along y; the sensor is half a metre ahead of it and one up.
  PlaneSensorSpec spec = plane_camera();
  spec.T_body_sensor.t = Vec3(0.5, 0, 1);
  const WallPlan plan = plan_of({{{8, 25}, {12, 25}}});
  const Pose pose{from_yaw_pitch_roll(90 * kDegree, 0, 0), {10, 20, 0}};
  const auto planes = observe(PlaneSensor(spec, plan, 1), pose);
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_TRUE(reaches(planes[0], {4.5, 2}, {4.5, -2}));
  EXPECT_NEAR(planes[0].plane.offset, -4.5, 1e-12);
}

TEST(PlaneSensor, CutsAWallAtTheBorderOfItsView) {
  const auto planes = seen_of(plane_camera(), plan_of({{{5, 10}, {5, -2}}}));
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_TRUE(reaches(planes[0], {5, 5}, {5, -2}));
}

TEST(PlaneSensor, CutsAWallBesideItAtBothBorders) {
  const WallPlan plan = plan_of({{{-3, 1.5}, {30, 1.5}}});
  PlaneSensorSpec spec = plane_camera();
  const auto depth = seen_of(spec, plan);
  ASSERT_EQ(depth.size(), 1u);
  EXPECT_TRUE(reaches(depth[0], {1.5, 1.5}, {12, 1.5}));
  EXPECT_EQ(depth[0].plane.normal, Vec3(0, -1, 0));
  spec.view.bounded_sides = true;
  const auto circle = seen_of(spec, plan);
  ASSERT_EQ(circle.size(), 1u);
  EXPECT_TRUE(reaches(circle[0], {1.5, 1.5}, {std::sqrt(144 - 2.25), 1.5}));
}

TEST(PlaneSensor, SeesAsFarAsItsRangeAndNoFarther) {
  PlaneSensorSpec spec = plane_camera();
  EXPECT_EQ(seen_of(spec, plan_of({{{12, 2}, {12, -2}}})).size(), 1u);
  EXPECT_EQ(seen_of(spec, plan_of({{{12.001, 2}, {12.001, -2}}})).size(), 0u);
  // With a circle, the ends of a wall at 11 m are too far.
  const WallPlan plan = plan_of({{{11, 6}, {11, -6}}});
  EXPECT_TRUE(reaches(seen_of(spec, plan).at(0), {11, 6}, {11, -6}));
  spec.view.bounded_sides = true;
  const double half = std::sqrt(144 - 121);
  EXPECT_TRUE(reaches(seen_of(spec, plan).at(0), {11, half}, {11, -half}));
}

TEST(PlaneSensor, SeesNothingThatIsTooNear) {
  PlaneSensorSpec spec = plane_camera();
  spec.view.min_range_m = 2.0;
  const WallPlan beside = plan_of({{{-3, 1}, {30, 1}}});
  EXPECT_TRUE(reaches(seen_of(spec, beside).at(0), {2, 1}, {12, 1}));
  EXPECT_TRUE(seen_of(spec, plan_of({{{1, 1}, {1, -1}}})).empty());
  // As a circle it takes the middle out of a wall ahead.
  spec.view.bounded_sides = true;
  const auto ahead = seen_of(spec, plan_of({{{1.8, 1.5}, {1.8, -1.5}}}));
  const double half = std::sqrt(4 - 1.8 * 1.8);
  ASSERT_EQ(ahead.size(), 2u);
  EXPECT_TRUE(reaches(ahead[0], {1.8, 1.5}, {1.8, half}));
  EXPECT_TRUE(reaches(ahead[1], {1.8, -half}, {1.8, -1.5}));
}

TEST(PlaneSensor, SeesBothWallsOfACornerUpToIt) {
  const Vec2 corner(6, 1);
  const auto planes = seen_of(plane_camera(), plan_of({{{2, 1}, corner}, {corner, {6, -3}}}));
  ASSERT_EQ(walls_of(planes), (Walls{0, 1}));
  // Touching each other they hide nothing, not even by rounding.
  EXPECT_EQ(planes[0].corners[1].head<2>(), corner);
  EXPECT_EQ(planes[1].corners[0].head<2>(), corner);
}

TEST(PlaneSensor, SeesAWallInPiecesBesideAPillar) {
  auto walls = box_walls({4, -0.2}, {4.4, 0.2});
  walls.push_back({{8, 3}, {8, -3}});
  const WallPlan plan = plan_of(walls);
  PlaneSensorSpec spec = plane_camera();
  const auto hidden = seen_of(spec, plan);
  ASSERT_EQ(walls_of(hidden),
            (Walls{3, 4, 4}));  // the pillar's front, and the wall on both sides of its shadow
  EXPECT_TRUE(reaches(hidden[0], {4, 0.2}, {4, -0.2}));
  EXPECT_TRUE(reaches(hidden[1], {8, 3}, {8, 0.4}));
  EXPECT_TRUE(reaches(hidden[2], {8, -0.4}, {8, -3}));
  spec.view.occlusion = false;
  const auto all = seen_of(spec, plan);
  ASSERT_EQ(walls_of(all), (Walls{3, 4}));
  EXPECT_TRUE(reaches(all[1], {8, 3}, {8, -3}));
}

TEST(PlaneSensor, SeesThroughADoorWhatIsBehindIt) {
  const WallPlan plan = plan_of({{{4, 3}, {4, 0.5}}, {{4, -0.5}, {4, -3}}, {{8, 7}, {8, -6}}});
  const auto planes = seen_of(plane_camera(), plan);
  ASSERT_EQ(walls_of(planes), (Walls{0, 1, 2, 2}));
  EXPECT_TRUE(reaches(planes[2], {8, 7}, {8, 6}));  // beside the nearer wall's outer end
  EXPECT_TRUE(reaches(planes[3], {8, 1}, {8, -1}));
}

TEST(PlaneSensor, SeesNothingOfAWallBehindAnother) {
  const WallPlan plan = plan_of({{{4, 3}, {4, -3}}, {{8, 5}, {8, -5}}});
  EXPECT_EQ(walls_of(seen_of(plane_camera(), plan)), (Walls{0}));
  PlaneSensorSpec spec = plane_camera();
  spec.view.occlusion = false;
  EXPECT_EQ(walls_of(seen_of(spec, plan)), (Walls{0, 1}));
}

TEST(PlaneSensor, IsBlockedByWhatIsOutOfRangeOrFacesAway) {
  // Nearer than the sensor measures, and seen from behind: neither is given, both hide.
  WallPlan plan = plan_of({{{1, 0.2}, {1, -0.2}}, {{8, 4}, {8, -4}}});
  PlaneSensorSpec spec = plane_camera();
  spec.view.min_range_m = 2.0;
  EXPECT_EQ(walls_of(seen_of(spec, plan)), (Walls{1, 1}));
  plan = plan_of({{{4, -1}, {4, 1}}, {{8, 4}, {8, -4}}});
  const auto planes = seen_of(plane_camera(), plan);
  ASSERT_EQ(walls_of(planes), (Walls{1, 1}));
  EXPECT_TRUE(reaches(planes[0], {8, 4}, {8, 2}));
}

TEST(PlaneSensor, SeesNoWallFromBehind) {
  EXPECT_TRUE(seen_of(plane_camera(), plan_of({{{5, -2}, {5, 2}}})).empty());
}

TEST(PlaneSensor, SeesAWallUnlessItStandsInItsPlane) {
  const WallPlan plan = plan_of({{{2, 0}, {9, 0}}});  // its empty side is that of negative y
  EXPECT_TRUE(seen_of(plane_camera(), plan, standing(0, 0)).empty());
  EXPECT_TRUE(seen_of(plane_camera(), plan, standing(0, 0.001)).empty());
  const auto planes = seen_of(plane_camera(), plan, standing(0, -0.001));
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_TRUE(reaches(planes[0], {2, 0.001}, {9, 0.001}));
}

TEST(PlaneSensor, GivesNoPieceThatIsTooShort) {
  PlaneSensorSpec spec = plane_camera();
  const WallPlan plan = plan_of({{{5, 0.02}, {5, -0.02}}});
  EXPECT_TRUE(seen_of(spec, plan).empty());
  spec.view.min_length_m = 0.03;
  EXPECT_EQ(seen_of(spec, plan).size(), 1u);
}

TEST(PlaneSensor, SeesAllRound) {
  const WallPlan plan =
      plan_of({{{5, 5}, {5, -5}}, {{5, -5}, {-5, -5}}, {{-5, -5}, {-5, 5}}, {{-5, 5}, {5, 5}}});
  PlaneSensorSpec spec = plane_camera();
  spec.view.horizontal_fov = 360 * kDegree;
  const auto all = seen_of(spec, plan);
  ASSERT_EQ(walls_of(all), (Walls{0, 1, 2, 3}));
  EXPECT_TRUE(reaches(all[2], {-5, -5}, {-5, 5}));
  // With 300 degrees, a part of the wall behind is missing in its middle.
  spec.view.horizontal_fov = 300 * kDegree;
  const auto most = seen_of(spec, plan);
  ASSERT_EQ(most.size(), 5u);
  const double gap = 5 * std::tan(30 * kDegree);
  std::size_t behind = 0;
  for (const PlaneObservation& plane : most) {
    if (plane.true_plane != 2) continue;
    ++behind;
    EXPECT_TRUE(reaches(plane, {-5, -5}, {-5, -gap}) || reaches(plane, {-5, gap}, {-5, 5}));
  }
  EXPECT_EQ(behind, 2u);
  // With 180 degrees, half of those beside it.
  spec.view.horizontal_fov = 180 * kDegree;
  const auto half = seen_of(spec, plan);
  ASSERT_EQ(walls_of(half), (Walls{0, 1, 3}));
  EXPECT_TRUE(reaches(half[1], {5, -5}, {0, -5}));
}

TEST(PlaneSensor, BoundsItsRangeByACircleWhereItSeesMoreThanAhead) {
  PlaneSensorSpec spec = plane_camera();
  spec.view.horizontal_fov = 180 * kDegree;
  const auto planes = seen_of(spec, plan_of({{{-30, 5}, {30, 5}}}));
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_TRUE(reaches(planes[0], {0, 5}, {std::sqrt(144.0 - 25), 5}));
}

TEST(PlaneSensor, SeesNothingWhereThereIsNothing) {
  const WallPlan plan = plan_of({});
  std::vector<PlaneObservation> planes(3);
  PlaneSensor(plane_camera(), plan, 1).observe(standing(), 0, planes);
  EXPECT_TRUE(planes.empty());
}

TEST(PlaneSensor, RefusesAPoseThatIsNotLevelOrAtItsHeight) {
  const WallPlan plan = plan_of({{{5, 2}, {5, -2}}});
  const PlaneSensor sensor(plane_camera(), plan, 1);
  const auto message = [&](const Pose& pose) {
    const auto error = test::error_of([&] { observe(sensor, pose, 7); });
    if (!error) return std::string("none");
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
    EXPECT_EQ(error->where().element, "sensor `eyes`, step 7");
    return error->message();
  };
  const auto identity = Quat::Identity();
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e9})
    EXPECT_EQ(message({identity, {0, bad, 1}}), "the pose is not finite or too far from the origin");
  EXPECT_EQ(message({identity, {0, 0, 1.5}}),
            "is at the height 1.5 m; a sensor of planes stays at one, here 1 m");
  EXPECT_EQ(message({from_yaw_pitch_roll(0, 0.01, 0), {0, 0, 1}}),
            "is not level, as a sensor of planes must be");
  EXPECT_EQ(message({from_yaw_pitch_roll(0, 0, 180 * kDegree), {0, 0, 1}}),
            "is not level, as a sensor of planes must be");
}

struct BadSpec {
  const char* name;
  void (*spoil)(PlaneSensorSpec&);
  std::string message;  ///< how it begins
};

class PlaneSpec : public testing::TestWithParam<BadSpec> {};

TEST_P(PlaneSpec, IsRefused) {
  PlaneSensorSpec spec = plane_camera();
  GetParam().spoil(spec);
  const WallPlan plan = plan_of({});
  const auto error = test::error_of([&] { PlaneSensor(spec, plan, 1); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->where().element, "sensor `" + spec.name + "`");
  EXPECT_EQ(error->message().substr(0, GetParam().message.size()), GetParam().message);
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Bad, PlaneSpec,
    testing::Values(BadSpec{"NoName", [](auto& s) { s.name = ""; }, "name is empty"},
                    BadSpec{"Horizontal", [](auto& s) { s.view.horizontal_fov = 0; },
                            "horizontal_fov is 0 degrees"},
                    BadSpec{"Vertical", [](auto& s) { s.vertical_fov = 7; }, "vertical_fov is 401"},
                    BadSpec{"MinAboveMax", [](auto& s) { s.view.min_range_m = 13; },
                            "min_range_m is 13, above max_range_m"},
                    BadSpec{"Length", [](auto& s) { s.view.min_length_m = -1; }, "min_length_m is -1;"},
                    BadSpec{"Noise", [](auto& s) { s.noise_m = -1; }, "noise_m is -1;"},
                    BadSpec{"Angle", [](auto& s) { s.noise_angle = kNan; }, "noise_angle is nan;"},
                    BadSpec{"End", [](auto& s) { s.noise_end_m = -0.1; }, "noise_end_m is -0.1;"},
                    BadSpec{"Mount", [](auto& s) { s.T_body_sensor.t.x() = kNan; }, "T_body_sensor is not"}),
    [](const auto& bad) { return std::string(bad.param.name); });

}  // namespace
}  // namespace hallway::sense
