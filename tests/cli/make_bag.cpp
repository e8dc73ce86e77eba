// SPDX-License-Identifier: MIT
// make_bag FILE: writes the bag of the tests by ROS's own library. C++17, as ROS 1's headers need it.
#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "cli/bag_contents.hpp"

namespace {

namespace contents = hallway::test::bag;

ros::Time stamp(std::uint32_t message) {
  return {contents::kSeconds, contents::nanoseconds(message)};
}

template <typename T>
void put(std::vector<std::uint8_t>& data, std::size_t at, T value, bool big_endian) {
  std::uint8_t bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof value);
  if (big_endian) std::reverse(bytes, bytes + sizeof value);
  std::copy(bytes, bytes + sizeof value, data.begin() + static_cast<std::ptrdiff_t>(at));
}

/// Points of type T, with bytes of other fields before, between and behind the coordinates.
template <typename T>
sensor_msgs::PointCloud2 cloud(std::uint32_t message, bool big_endian) {
  constexpr std::uint32_t kSize = sizeof(T);
  sensor_msgs::PointCloud2 out;
  out.header.stamp = stamp(message);
  out.header.frame_id = "lidar";
  out.height = 1;
  out.width = contents::kPoints;
  out.point_step = 4 * kSize + 8;
  out.row_step = out.width * out.point_step;
  out.is_bigendian = big_endian;
  const char* names[] = {"x", "y", "z"};
  const std::uint32_t offsets[] = {4, 4 + kSize, 8 + 2 * kSize};
  out.data.resize(out.row_step);
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    sensor_msgs::PointField field;
    field.name = names[axis];
    field.offset = offsets[axis];
    field.datatype = kSize == 4 ? sensor_msgs::PointField::FLOAT32 : sensor_msgs::PointField::FLOAT64;
    field.count = 1;
    out.fields.push_back(field);
    for (std::uint32_t i = 0; i < contents::kPoints; ++i) {
      put(out.data, i * out.point_step + offsets[axis], static_cast<T>(contents::point(message, i)[axis]),
          big_endian);
    }
  }
  return out;
}

sensor_msgs::LaserScan scan(std::uint32_t message) {
  sensor_msgs::LaserScan out;
  out.header.stamp = stamp(message);
  out.angle_min = contents::kAngleMin;
  out.angle_increment = contents::kAngleIncrement;
  out.range_min = contents::kRangeMin;
  out.range_max = contents::kRangeMax;
  for (std::uint32_t i = 0; i < contents::kBeams; ++i) {
    out.ranges.push_back(contents::hits(i) ? contents::range(message, i)
                                           : std::numeric_limits<float>::infinity());
  }
  return out;
}

/// A body that moves by 1 m along y and turns by 0.1 about z from pose to pose.
geometry_msgs::Pose pose(std::uint32_t number) {
  geometry_msgs::Pose out;
  out.position.y = number;
  out.orientation.w = std::cos(0.05 * number);
  out.orientation.z = std::sin(0.05 * number);
  return out;
}

void write_poses(rosbag::Bag& bag) {
  for (std::uint32_t i = 0; i <= contents::kMessages; ++i) {
    const ros::Time time(contents::kSeconds, contents::pose_nanoseconds(i));
    nav_msgs::Odometry odometry;
    odometry.header.stamp = time;
    odometry.pose.pose = pose(i);
    bag.write("/odom", time, odometry);
    geometry_msgs::PoseStamped stamped;
    stamped.header.stamp = time;
    stamped.pose = pose(i);
    bag.write("/mocap", time, stamped);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  rosbag::Bag bag;
  bag.open(argv[1], rosbag::bagmode::Write);
  bag.setChunkThreshold(4096);
  for (std::uint32_t i = 0; i < contents::kMessages; ++i) {
    auto first = cloud<float>(i, false);
    if (i == contents::kNotFiniteMessage) {
      put(first.data, contents::kNotFinitePoint * first.point_step + 4,
          std::numeric_limits<float>::quiet_NaN(), false);
    }
    bag.write("/cloud", stamp(i), first);
    bag.write("/cloud_big", stamp(i), cloud<double>(i, true));
    bag.write("/scan", stamp(i), scan(i));
    bag.write("/clicked", stamp(i), geometry_msgs::PointStamped());
  }
  write_poses(bag);
  // Stamps that run backwards, though the bag does not.
  for (std::uint32_t i = 0; i < 2; ++i) bag.write("/backwards", stamp(i), scan(1 - i));
  bag.close();
  return 0;
}
