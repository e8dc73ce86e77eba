// SPDX-License-Identifier: MIT
#include "ros1/readings.hpp"

#include <sensor_msgs/PointField.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace hallway::ros1 {
namespace {

/// Where a coordinate stands in a point.
struct Coordinate {
  std::size_t offset = 0;
  bool is_double = false;
};

Coordinate find_coordinate(const sensor_msgs::PointCloud2& cloud, const char* name) {
  for (const sensor_msgs::PointField& field : cloud.fields) {
    if (field.name != name) continue;
    const bool is_double = field.datatype == sensor_msgs::PointField::FLOAT64;
    if (!is_double && field.datatype != sensor_msgs::PointField::FLOAT32) {
      throw Malformed(std::string("field ") + name + " is neither float32 nor float64");
    }
    if (std::uint64_t{field.offset} + (is_double ? 8 : 4) > cloud.point_step) {
      throw Malformed(std::string("field ") + name + " reaches over point_step");
    }
    return {field.offset, is_double};
  }
  throw Malformed(std::string("there is no field ") + name);
}

/// Checks that width × height points of point_step bytes stand in the data; a row is row_step bytes long.
void check_extent(const sensor_msgs::PointCloud2& cloud) {
  const std::uint64_t count = std::uint64_t{cloud.width} * cloud.height;
  if (count > kMaxPoints) throw Malformed("it has more than " + std::to_string(kMaxPoints) + " points");
  if (cloud.point_step == 0) throw Malformed("point_step is 0");
  const std::uint64_t row = std::uint64_t{cloud.width} * cloud.point_step;
  if (cloud.height > 1 && row > cloud.row_step) throw Malformed("width points are longer than row_step");
  const std::uint64_t last_row = std::uint64_t{cloud.height - 1} * cloud.row_step;
  if ((cloud.height > 1 ? last_row : 0) + row > cloud.data.size()) {
    throw Malformed("the data are shorter than width, height and point_step say");
  }
}

/// A number of this width from bytes in the given order.
template <typename Number>
double read_number(const std::uint8_t* bytes, bool swapped) {
  std::array<std::uint8_t, sizeof(Number)> raw{};
  std::memcpy(raw.data(), bytes, raw.size());
  if (swapped) std::reverse(raw.begin(), raw.end());
  Number number;
  std::memcpy(&number, raw.data(), sizeof number);
  return static_cast<double>(number);
}

double read_coordinate(const std::uint8_t* point, const Coordinate& coordinate, bool swapped) {
  const std::uint8_t* at = point + coordinate.offset;
  return coordinate.is_double ? read_number<double>(at, swapped) : read_number<float>(at, swapped);
}

bool is_finite(const hw_point3_t& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

}  // namespace

Points read_cloud(const sensor_msgs::PointCloud2& cloud) {
  Points result;
  const Coordinate x = find_coordinate(cloud, "x");
  const Coordinate y = find_coordinate(cloud, "y");
  const Coordinate z = find_coordinate(cloud, "z");
  if (cloud.width == 0 || cloud.height == 0) return result;
  check_extent(cloud);
  const bool swapped = cloud.is_bigendian != 0;  // Hallway runs on little-endian machines only
  result.points.reserve(std::size_t{cloud.width} * cloud.height);
  for (std::size_t row = 0; row < cloud.height; ++row) {
    const std::uint8_t* point = cloud.data.data() + row * cloud.row_step;
    for (std::size_t column = 0; column < cloud.width; ++column, point += cloud.point_step) {
      const hw_point3_t read{read_coordinate(point, x, swapped), read_coordinate(point, y, swapped),
                             read_coordinate(point, z, swapped)};
      if (is_finite(read)) result.points.push_back(read);
    }
  }
  result.dropped = std::uint64_t{cloud.width} * cloud.height - result.points.size();
  return result;
}

Points read_scan(const sensor_msgs::LaserScan& scan) {
  if (!std::isfinite(scan.angle_min) || !std::isfinite(scan.angle_increment)) {
    throw Malformed("its angles are not finite");
  }
  if (scan.ranges.size() > kMaxPoints)
    throw Malformed("it has more than " + std::to_string(kMaxPoints) + " ranges");
  Points result;
  result.points.reserve(scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double range = static_cast<double>(scan.ranges[i]);
    const bool within = scan.ranges[i] >= scan.range_min && scan.ranges[i] <= scan.range_max;
    if (!std::isfinite(range) || !within) continue;
    const double angle = static_cast<double>(scan.angle_min) +
                         static_cast<double>(i) * static_cast<double>(scan.angle_increment);
    result.points.push_back({range * std::cos(angle), range * std::sin(angle), 0});
  }
  result.dropped = scan.ranges.size() - result.points.size();
  return result;
}

}  // namespace hallway::ros1
