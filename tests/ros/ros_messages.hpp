// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/PointField.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace hallway::test {

inline sensor_msgs::PointField cloud_field(const char* name, std::uint32_t offset, std::uint8_t datatype) {
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = offset;
  field.datatype = datatype;
  field.count = 1;
  return field;
}

inline ros::Time ros_time(std::int64_t t_ns) {
  return {static_cast<std::uint32_t>(t_ns / 1'000'000'000), static_cast<std::uint32_t>(t_ns % 1'000'000'000)};
}

/// The points with float64 coordinates, to the last bit.
inline sensor_msgs::PointCloud2 cloud_of(const std::vector<hw_point3_t>& points, std::int64_t t_ns,
                                         const std::string& frame = "sensor") {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.stamp = ros_time(t_ns);
  cloud.header.frame_id = frame;
  for (const auto& [name, offset] : {std::pair{"x", 0u}, {"y", 8u}, {"z", 16u}}) {
    cloud.fields.push_back(cloud_field(name, offset, sensor_msgs::PointField::FLOAT64));
  }
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(points.size());
  cloud.point_step = sizeof(hw_point3_t);
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.data.resize(points.size() * sizeof(hw_point3_t));
  if (!points.empty()) std::memcpy(cloud.data.data(), points.data(), cloud.data.size());
  return cloud;
}

}  // namespace hallway::test
