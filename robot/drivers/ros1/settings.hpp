// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/driver.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace hallway::ros1 {

/// Where a sensor is mounted.
struct Mount {
  std::optional<hw_pose_t> T_body_sensor{hw_pose_t{{0, 0, 0}, {1, 0, 0, 0}}};  ///< unset: tf says so
  std::string tf_frame{};  ///< the sensor's frame in tf; empty: that of the first message
};

/// One topic that is read, as a sensor of the robot.
struct SensorSettings {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  std::string topic{};
  bool is_scan = false;  ///< sensor_msgs/LaserScan, else sensor_msgs/PointCloud2
  Mount mount{};
  double noise_m[3] = {kUnknown, kUnknown, kUnknown};
  double horizontal_fov = kUnknown;  ///< full angle, radians
  double vertical_fov = kUnknown;    ///< full angle, radians
  double min_range_m = kUnknown;
  double max_range_m = kUnknown;
};

/// What the driver is opened with. A topic that is empty is not published.
struct Settings {
  std::string master{};              ///< http://HOST:PORT
  std::string address{};             ///< how other nodes reach this one; empty: what roscpp finds
  std::string node = "hallway";      ///< name of the node
  std::chrono::milliseconds wait{};  ///< longest wait for master and tf, each
  std::vector<SensorSettings> sensors{};
  std::string command_topic = "cmd_vel";
  std::string pose_topic = "hallway/pose";
  std::string path_topic = "hallway/path";
  std::string map_topic = "hallway/map";
  std::string diagnostics_topic = "/diagnostics";
  std::size_t path_length = 1000;  ///< most poses in the path
  bool tf = false;                 ///< whether map_frame → base_frame is published
  std::string map_frame = "map";
  std::string base_frame = "base_link";
  std::size_t queue = 4;  ///< readings that wait at most
  std::int64_t period_ns = 0;
  bool lock_step = false;
};

/// The settings for people, a line for each.
const char* settings_help();

/// Reads and checks the settings. `master` falls back on ROS_MASTER_URI, which is how every ROS program is told.
/// Throws sdk::Failure naming the key.
Settings read_settings(const sdk::DriverSettings& given);

}  // namespace hallway::ros1
