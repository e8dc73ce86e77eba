// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "import/recording.hpp"

namespace hallway::import {

/// Largest coordinate that lidar clouds and poses of other programs may have. What is larger was read as another type or in another byte order.
inline constexpr double kMaxImport_m = 1e9;

/// Longest time from a cloud's own time to that of one of its points. What is longer is no offset.
inline constexpr std::int64_t kMaxPointOffset_ns = 3'600'000'000'000;

/// The points of a lidar in its frame (x forward, y left, z up), and what else the file has of each.
struct LidarCloud {
  PointList points;                   ///< metres, all finite
  std::vector<float> intensity{};     ///< empty, or one for each point, in the unit of the file
  std::vector<std::uint32_t> ring{};  ///< empty, or one for each point: which laser
  std::vector<std::int64_t>
      t_offset_ns{};  ///< empty, or one for each point: time after the cloud's own; below 0 where that is the scan's end
  std::uint64_t not_finite = 0;  ///< points that were left out since a coordinate is none
};

/// Checks a cloud before it is written. Throws Error{kBadInput} with the file and the number of the first point that is not finite or lies beyond
/// kMaxImport_m, where a list has another length than `points`, and for more than kMaxFramePoints.
void check_cloud(const LidarCloud& cloud, const std::string& file);

/// Reads a PCD file, in each form that read_pcd() reads. Besides x, y and z, of any type, these fields:
///   intensity  a number; not finite: NaN
///   ring       a whole number from 0 to 2^32 - 1
///   t          of type I or U: nanoseconds after the cloud's time; of type F: seconds
///   time       of type F: seconds after the cloud's time. Read where there is no `t`
/// All others are passed over. Points that are not finite are left out. Throws Error{kBadInput} with file and line, of binary data with the byte.
LidarCloud parse_lidar_pcd(std::string_view content, const std::string& file);

/// The same cloud as a binary PCD file: x, y, z and intensity of type F 4; ring of type U 2, where a ring is above 65535 U 4; t of type U 4, where a time
/// does not fit I 8. A list that is empty has no field. Throws as check_cloud().
std::string print_lidar_pcd(const LidarCloud& cloud, const std::string& file);

}  // namespace hallway::import
