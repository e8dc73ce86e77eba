// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/gnss.h>
#include <hallway/imu.h>
#include <hallway/robot.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/sensor_info.hpp"

namespace hallway::host {

/// The names of drives in files, in the order of HW_DRIVE_….
inline constexpr std::array<std::string_view, 5> kDriveNames{"unknown", "differential", "tracked",
                                                             "ackermann", "omnidirectional"};

/// What is known of a robot's drive; see hw_drive_info_t. A number that is not known is NaN.
struct DriveInfo {
  std::uint32_t kind = HW_DRIVE_UNKNOWN;
  double max_speed_m_s = kUnknown;
  double max_lateral_m_s = kUnknown;
  double max_angular_rad_s = kUnknown;
  double max_acceleration_m_s2 = kUnknown;
  double max_deceleration_m_s2 = kUnknown;
  double max_angular_acceleration_rad_s2 = kUnknown;
  double greatest_steering_rad = kUnknown;
  double max_steering_rate_rad_s = kUnknown;
  double wheel_base_m = kUnknown;
  double axle_distance_m = kUnknown;
  double wheel_radius_m = kUnknown;
  double latency_s = kUnknown;
  double dead_band_m_s = kUnknown;
  double dead_band_rad_s = kUnknown;

  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
};

/// A number of DriveInfo.
struct DriveNumber {
  std::string_view key;  ///< its name in files
  double DriveInfo::*host;
  double hw_drive_info_t::*abi;
};

/// All of them, in the order of hw_drive_info_t.
std::span<const DriveNumber> drive_numbers();

/// A number of ImuIntrinsics.
struct ImuNumber {
  std::string_view key;  ///< its name in files
  double ImuIntrinsics::*host;
  double hw_imu_info_t::*abi;
};

/// All of them, in the order of hw_imu_info_t.
std::span<const ImuNumber> imu_numbers();

/// The number HW_DRIVE_… of a name; empty if there is none.
std::optional<std::uint32_t> drive_kind(std::string_view name);

/// What is known of a robot's body; see hw_body_info_t.
struct BodyInfo {
  std::vector<std::array<double, 2>> corners{};  ///< counter-clockwise; empty: a circle
  double radius_m = DriveInfo::kUnknown;         ///< of the circle; of a polygon see outer_radius_m()
  double bottom_m = DriveInfo::kUnknown;
  double top_m = DriveInfo::kUnknown;
};

/// hw_body_info_t.radius_m: of a polygon the distance of its farthest corner.
double outer_radius_m(const BodyInfo& body);

/// Most corners of a body.
inline constexpr std::size_t kMaxBodyCorners = 256;

/// What is wrong with them, for a message; empty: nothing. Numbers are finite or NaN, lengths, speeds and rates not below 0; corners are 3 at least, their
/// polygon convex and counter-clockwise; a bottom is not above its top.
std::string problem_of(const DriveInfo& drive);
std::string problem_of(const BodyInfo& body);
/// Likewise of a sensor's intrinsics: they fit its kind, directions have unit length.
std::string problem_of_intrinsics(const SensorInfo& sensor);
/// Likewise of a sensor's rate, latency, growth of noise, and intrinsics.
std::string problem_of(const SensorInfo& sensor);

}  // namespace hallway::host
