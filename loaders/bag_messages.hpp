// SPDX-License-Identifier: MIT
#pragma once

// Plain data between ROS's messages and what is made of them. Read also by the one source file that includes ROS, which is C++17.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace hallway::loaders::bag {

/// A field of a point, as sensor_msgs/PointField has it.
struct CloudField {
  std::string name;
  std::uint32_t offset = 0;   ///< bytes from the point's begin
  std::uint8_t datatype = 0;  ///< 7: 32-bit float, 8: 64-bit float
};

/// sensor_msgs/PointCloud2, unchecked.
struct Cloud {
  std::int64_t t_ns = 0;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::uint32_t point_step = 0;
  std::uint32_t row_step = 0;
  bool big_endian = false;
  std::vector<CloudField> fields;
  std::vector<std::uint8_t> data;
};

/// sensor_msgs/LaserScan, unchecked: beam i looks along angle_min + i * angle_increment, counter-clockwise from x.
struct Scan {
  std::int64_t t_ns = 0;
  float angle_min = 0.0f;
  float angle_increment = 0.0f;
  float range_min = 0.0f;
  float range_max = 0.0f;
  std::vector<float> ranges;
};

/// The pose of nav_msgs/Odometry or geometry_msgs/PoseStamped.
struct StampedPose {
  std::int64_t t_ns = 0;
  std::array<double, 3> position_m{};
  std::array<double, 4> orientation{};  ///< w, x, y, z
};

/// A topic of a bag.
struct Topic {
  std::string name;
  std::string type;  ///< "sensor_msgs/PointCloud2"
  std::uint64_t messages = 0;
};

}  // namespace hallway::loaders::bag
