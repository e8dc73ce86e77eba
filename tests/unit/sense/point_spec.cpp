// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "support/errors.hpp"
#include "unit/sense/sensor_fixture.hpp"

namespace hallway::sense {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct BadSpec {
  const char* name;
  std::function<void(PointSensorSpec&)> spoil;
  std::string message;  ///< how the message begins
};

class PointSpec : public testing::TestWithParam<BadSpec> {};

TEST_P(PointSpec, IsRefused) {
  PointSensorSpec spec = test::camera();
  GetParam().spoil(spec);
  const std::vector<Vec3> landmarks;
  const auto error =
      test::error_of([&] { PointSensor(spec, LandmarkIndex(landmarks), test::empty_scene(), 1); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->where().element, "sensor `" + spec.name + "`");
  EXPECT_EQ(error->message().substr(0, GetParam().message.size()), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Bad, PointSpec,
    testing::Values(
        BadSpec{"NoName", [](auto& s) { s.name = ""; }, "name is empty"},
        BadSpec{"HorizontalZero", [](auto& s) { s.horizontal_fov = 0.0; }, "horizontal_fov is 0 degrees"},
        BadSpec{"HorizontalOver360", [](auto& s) { s.horizontal_fov = 6.3; }, "horizontal_fov is 360.96"},
        BadSpec{"HorizontalNan", [](auto& s) { s.horizontal_fov = kNan; }, "horizontal_fov is nan"},
        BadSpec{"VerticalNegative", [](auto& s) { s.vertical_fov = -1.0; }, "vertical_fov is -57.29"},
        BadSpec{"VerticalInfinite", [](auto& s) { s.vertical_fov = kInfinity; }, "vertical_fov is inf"},
        BadSpec{"MinNegative", [](auto& s) { s.min_range_m = -0.5; }, "min_range_m is -0.5;"},
        BadSpec{"MinNan", [](auto& s) { s.min_range_m = kNan; }, "min_range_m is nan;"},
        BadSpec{"MaxInfinite", [](auto& s) { s.max_range_m = kInfinity; }, "max_range_m is inf;"},
        BadSpec{"MinAboveMax", [](auto& s) { s.min_range_m = 101.0; },
                "min_range_m is 101, above max_range_m, 100"},
        BadSpec{"NoiseNegative", [](auto& s) { s.noise_m.y() = -0.1; }, "noise_m is -0.1;"},
        BadSpec{"GrowthNegative", [](auto& s) { s.noise_per_m.x() = -0.1; }, "noise_per_m is -0.1;"},
        BadSpec{"NoiseNan", [](auto& s) { s.noise_m.z() = kNan; }, "noise_m is nan;"},
        BadSpec{"MountNan", [](auto& s) { s.T_body_sensor.t.x() = kNan; }, "T_body_sensor is not"},
        BadSpec{"MountNotUnit", [](auto& s) { s.T_body_sensor.q.w() = 2.0; }, "T_body_sensor is not"}),
    [](const auto& bad) { return std::string(bad.param.name); });

TEST(PointSpecLimits, AreAllowed) {
  const std::vector<Vec3> landmarks;
  PointSensorSpec spec = test::camera();
  spec.horizontal_fov = spec.vertical_fov = 360.0 * (3.14159265358979323846 / 180.0);
  spec.min_range_m = spec.max_range_m = 0.0;
  EXPECT_NO_THROW(PointSensor(spec, LandmarkIndex(landmarks), test::empty_scene(), 1));
}

TEST(PointSpecLandmarks, MustBeFinite) {
  const std::vector<Vec3> landmarks = {{0, 0, 0}, {0, kNan, 0}};
  const auto error =
      test::error_of([&] { PointSensor(test::camera(), LandmarkIndex(landmarks), test::empty_scene(), 1); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->where().element, "landmark 1");
}

TEST(PointSpecName, IsEchoedSafely) {
  PointSensorSpec spec = test::camera();
  spec.name = "a\x1b[31m";
  spec.vertical_fov = 0.0;
  const std::vector<Vec3> landmarks;
  const auto error =
      test::error_of([&] { PointSensor(spec, LandmarkIndex(landmarks), test::empty_scene(), 1); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->where().element, "sensor `a\\x1b[31m`");
}

}  // namespace
}  // namespace hallway::sense
