// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace hallway::ros1 {

/// Most points of one message; more is a message that is not meant.
inline constexpr std::uint64_t kMaxPoints = 4'000'000;

/// Why a message cannot be read.
class Malformed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The points of a message, and how many of it were not used.
struct Points {
  std::vector<hw_point3_t> points{};  ///< sensor frame, metres, finite
  std::uint64_t dropped = 0;          ///< not finite, or outside of the scan's limits
};

/// The points of a cloud: fields x, y, z, float32 or float64 at any offset and in either byte order; other fields
/// are passed over. Points that are not finite are dropped. Throws Malformed.
Points read_cloud(const sensor_msgs::PointCloud2& cloud);

/// The points of a scan, in its plane z = 0. Ranges that are not finite or outside of [range_min, range_max] are dropped.
/// Throws Malformed.
Points read_scan(const sensor_msgs::LaserScan& scan);

}  // namespace hallway::ros1
