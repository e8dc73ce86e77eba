// SPDX-License-Identifier: MIT
#include "sense/describe.hpp"

#include <gtest/gtest.h>
#include <hallway/sample.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "host/robot_parts.hpp"

namespace hallway::sense {
namespace {

constexpr std::uint32_t kPoints = HW_SAMPLE_POINTS, kPlanes = HW_SAMPLE_PLANES;

TEST(Describe, ASensorOfPoints) {
  PointSensorSpec spec;
  spec.name = "eyes";
  spec.T_body_sensor = {Quat(0.6, 0, 0, 0.8), Vec3(1, 2, 3)};
  spec.horizontal_fov = 1.5;
  spec.vertical_fov = 0.5;
  spec.min_range_m = 0.25;
  spec.max_range_m = 8;
  spec.noise_m = Vec3(0.01, 0.02, 0.03);
  const host::SensorInfo info = describe(spec, 7);
  EXPECT_EQ(info.id, 7u);
  EXPECT_EQ(info.kind, kPoints);
  EXPECT_EQ(info.name, "eyes");
  EXPECT_EQ(info.T_body_sensor.position[2], 3);
  EXPECT_EQ(info.T_body_sensor.orientation[0], 0.6) << "w comes first";
  EXPECT_EQ(info.T_body_sensor.orientation[3], 0.8);
  EXPECT_EQ(info.horizontal_fov, 1.5);
  EXPECT_EQ(info.vertical_fov, 0.5);
  EXPECT_EQ(info.min_range_m, 0.25);
  EXPECT_EQ(info.max_range_m, 8);
  EXPECT_EQ(info.noise_m[0], 0.01);
  EXPECT_EQ(info.noise_m[2], 0.03);
}

TEST(Describe, ASensorOfPlanes) {
  PlaneSensorSpec spec;
  spec.name = "walls";
  spec.view.max_range_m = 8;
  spec.noise_m = 0.01;
  const host::SensorInfo walls = describe(spec, 0);
  EXPECT_EQ(walls.kind, kPlanes);
  EXPECT_EQ(walls.max_range_m, 8);
  EXPECT_EQ(walls.noise_m[1], 0.01);
  EXPECT_EQ(walls.noise_m[2], 0.0) << "the normals of walls are level";
  spec.shape = PlaneShape::faces;
  const host::SensorInfo faces = describe(spec, 0);
  EXPECT_EQ(faces.kind, kPlanes);
  EXPECT_EQ(faces.noise_m[2], 0.01);
}

/// Whether a contact at that angle presses the zone.
bool presses(const BumpSensor& sensor, double angle_rad) {
  const Vec3 out(std::cos(angle_rad), std::sin(angle_rad), 0.0);
  const BumpContact contact{.point = 0.2 * out, .normal = -out, .gap_m = 0.0, .T_world_body = {}};
  return sensor.truth({&contact, 1}).pressed.at(0);
}

TEST(Describe, TheZonesOfABumperAreThoseThatArePressed) {
  const std::pair<double, double> sectors[] = {
      {-0.5, 0.75}, {3.0, 4.0}, {6.0, 0.25}, {1.0, 1.0}, {-7.0, -6.5}};
  for (const auto& [from, to] : sectors) {
    BumpSensorSpec spec{.name = "bumper", .zones = {{.name = "zone", .from_rad = from, .to_rad = to}}};
    const host::SensorInfo info = describe(spec, 3);
    EXPECT_EQ(host::problem_of_intrinsics(info), "");
    const host::BumpZoneInfo& zone = std::get<host::BumpIntrinsics>(info.intrinsics).zones.at(0);
    EXPECT_EQ(zone.name, "zone");
    EXPECT_TRUE(std::isnan(zone.bottom_m) && std::isnan(zone.top_m)) << "it has no ends";
    const BumpSensor sensor(spec, 1);
    for (int i = 0; i < 1000; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.5) / 1000;
      const double aside = std::abs(std::remainder(angle - zone.middle_rad, 2.0 * std::numbers::pi));
      EXPECT_EQ(presses(sensor, angle), aside < 0.5 * zone.width_rad) << from << " " << to << " " << angle;
    }
  }
  const BumpSensorSpec low{.name = "bumper", .zones = {{"low", 0.0, 1.0, 0.05, 0.3}}};
  const host::SensorInfo info = describe(low, 3);
  EXPECT_EQ(std::get<host::BumpIntrinsics>(info.intrinsics).zones.at(0).bottom_m, 0.05);
  EXPECT_EQ(std::get<host::BumpIntrinsics>(info.intrinsics).zones.at(0).top_m, 0.3);
}

TEST(Describe, AZoneThatIsNoSectorHasNoDirection) {
  BumpSensorSpec spec{.name = "bumper", .zones = {{.name = "edge", .bottom_m = 0.05, .top_m = 0.3}}};
  spec.zones[0].region = {{Vec3::UnitX(), 0.1}};
  const host::SensorInfo info = describe(spec, 3);
  EXPECT_EQ(host::problem_of_intrinsics(info), "");
  const host::BumpZoneInfo& zone = std::get<host::BumpIntrinsics>(info.intrinsics).zones.at(0);
  EXPECT_TRUE(std::isnan(zone.middle_rad) && std::isnan(zone.width_rad));
  EXPECT_EQ(zone.top_m, 0.3);
}

}  // namespace
}  // namespace hallway::sense
