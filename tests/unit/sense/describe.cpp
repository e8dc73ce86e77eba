// SPDX-License-Identifier: MIT
#include "sense/describe.hpp"

#include <gtest/gtest.h>
#include <hallway/sample.h>

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

}  // namespace
}  // namespace hallway::sense
