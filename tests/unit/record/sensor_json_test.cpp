// SPDX-License-Identifier: MIT
#include "record/sensor_json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "host/samples/point_kind.hpp"
#include "support/errors.hpp"

namespace hallway::record {
namespace {

TEST(SensorJson, KeepsEveryBitAndWhatIsUnknown) {
  host::SensorInfo sensor = host::point_sensor("eyes");
  sensor.T_body_sensor = {{1.0 / 3.0, -2e-9, 7.0}, {0.5, -0.5, 0.5, 0.5}};
  sensor.horizontal_fov = 1.0 / 3.0;
  sensor.noise_m[0] = 0.1;
  const host::SensorInfo back = read_sensor(nlohmann::ordered_json::parse(print_sensor(sensor).dump()));
  EXPECT_EQ(back.name, "eyes");
  EXPECT_EQ(back.kind, sensor.kind);
  EXPECT_EQ(back.horizontal_fov, sensor.horizontal_fov);
  EXPECT_TRUE(std::isnan(back.vertical_fov));
  EXPECT_EQ(back.noise_m[0], 0.1);
  EXPECT_TRUE(std::isnan(back.noise_m[2]));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(back.T_body_sensor.position[i], sensor.T_body_sensor.position[i]);
  for (int i = 0; i < 4; ++i)
    EXPECT_EQ(back.T_body_sensor.orientation[i], sensor.T_body_sensor.orientation[i]);
}

TEST(SensorJson, WrongMemberIsBadInput) {
  const auto error = test::error_of([] { read_sensor(nlohmann::ordered_json::parse(R"({"name": 3})")); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
}

}  // namespace
}  // namespace hallway::record
