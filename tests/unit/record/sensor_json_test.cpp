// SPDX-License-Identifier: MIT
#include "record/sensor_json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "host/samples/point_kind.hpp"
#include "record/robot_parts_json.hpp"
#include "support/errors.hpp"
#include "support/known_robot.hpp"

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

nlohmann::ordered_json parsed_again(const nlohmann::ordered_json& json) {
  return nlohmann::ordered_json::parse(json.dump());
}

TEST(SensorJson, DriveBodyAndIntrinsicsKeepEveryBit) {
  const host::Activation robot = test::known_robot();
  nlohmann::ordered_json json{{"drive", print_drive(*robot.drive)}, {"body", print_body(*robot.body)}};
  host::Activation back{{}, read_drive_in(parsed_again(json)), read_body_in(parsed_again(json))};
  for (const host::SensorInfo& sensor : robot.sensors)
    back.sensors.push_back(read_sensor(parsed_again(print_sensor(sensor))));
  test::expect_same_robot(back, robot);
  json = {{"drive", print_drive({})}, {"body", print_body({})}};
  test::expect_same_robot({{}, read_drive_in(parsed_again(json)), read_body_in(parsed_again(json))},
                          {{}, host::DriveInfo{}, host::BodyInfo{}});
  EXPECT_FALSE(read_drive_in({{"sensors", {}}}));
  EXPECT_FALSE(read_body_in({{"sensors", {}}}));
}

TEST(SensorJson, OfASensorOfWhichNoMoreIsKnownIsAsItWas) {
  EXPECT_EQ(print_sensor(host::point_sensor("eyes")).dump(),
            R"({"name":"eyes","kind":"points","T_body_sensor":{"position_m":[0.0,0.0,0.0],)"
            R"("orientation_wxyz":[1.0,0.0,0.0,0.0]},"horizontal_fov_rad":null,"vertical_fov_rad":null,)"
            R"("min_range_m":null,"max_range_m":null,"noise_m":[null,null,null]})");
}

TEST(SensorJson, RatesAndIntrinsicsWithoutSenseAreBadInput) {
  const host::Activation robot = test::known_robot();
  const auto refused = [](nlohmann::ordered_json json, const char* key, const nlohmann::ordered_json& value) {
    json[nlohmann::ordered_json::json_pointer(key)] = value;
    const auto error = test::error_of([&] { read_sensor(json); });
    return error && error->code() == ErrorCode::kBadInput;
  };
  const nlohmann::ordered_json lidar = print_sensor(robot.sensors[3]), imu = print_sensor(robot.sensors[4]);
  EXPECT_FALSE(refused(lidar, "/rate_hz", nullptr));
  EXPECT_TRUE(refused(lidar, "/rate_hz", -1));
  EXPECT_TRUE(refused(lidar, "/latency_s", "late"));
  EXPECT_TRUE(refused(lidar, "/noise_per_m", {0.1}));
  EXPECT_TRUE(refused(lidar, "/intrinsics/width", 0));
  EXPECT_TRUE(refused(lidar, "/intrinsics/scan_s", -0.1));
  EXPECT_FALSE(refused(imu, "/intrinsics/force_walk", nullptr));
  EXPECT_TRUE(refused(imu, "/intrinsics/force_walk", -1));
}

TEST(SensorJson, LaterDrivesAreReadAsFarAsTheyAreKnown) {
  const auto drive = read_drive_in(
      nlohmann::ordered_json::parse(R"({"drive": {"kind": "legs", "max_speed_m_s": 2, "n_legs": 6}})"));
  ASSERT_TRUE(drive);
  EXPECT_EQ(drive->kind, std::uint32_t{HW_DRIVE_UNKNOWN});
  EXPECT_EQ(drive->max_speed_m_s, 2.0);
  EXPECT_TRUE(std::isnan(drive->wheel_base_m));
}

TEST(SensorJson, WrongPartsAreBadInput) {
  for (const char* text :
       {R"({"drive": 3})", R"({"drive": {"kind": "tracked", "max_speed_m_s": -1}})",
        R"({"body": {"corners_m": [[0, 0], [1, 0]]}})", R"({"body": {"corners_m": [[0], [1, 0], [1, 1]]}})",
        R"({"body": {"radius_m": "wide"}})"}) {
    const auto error = test::error_of([&] {
      const auto json = nlohmann::ordered_json::parse(text);
      read_drive_in(json);
      read_body_in(json);
    });
    ASSERT_TRUE(error) << text;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  }
}

TEST(SensorJson, WrongMemberIsBadInput) {
  const auto error = test::error_of([] { read_sensor(nlohmann::ordered_json::parse(R"({"name": 3})")); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
}

}  // namespace
}  // namespace hallway::record
