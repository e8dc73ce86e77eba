// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace hallway::host {

// What else is known of a sensor, by its kind; see hw_sensor_info_t.intrinsics. A number that is not known is NaN.

/// A wheel with an encoder; see hw_encoder_wheel_t.
struct EncoderWheel {
  double m_per_tick = std::numeric_limits<double>::quiet_NaN();
  std::array<double, 3> position{};
  std::array<double, 3> direction{1.0, 0.0, 0.0};
};

/// Of a sensor of wheel encoders; see hw_encoder_info_t.
struct EncoderIntrinsics {
  std::vector<EncoderWheel> wheels{};
};

/// A contact zone; see hw_bump_zone_info_t.
struct BumpZoneInfo {
  std::string name{};
  double middle_rad = std::numeric_limits<double>::quiet_NaN();
  double width_rad = std::numeric_limits<double>::quiet_NaN();
  double bottom_m = std::numeric_limits<double>::quiet_NaN();
  double top_m = std::numeric_limits<double>::quiet_NaN();
};

/// Of a sensor of contact zones; see hw_bump_info_t.
struct BumpIntrinsics {
  std::vector<BumpZoneInfo> zones{};
};

/// Of a sensor of rays; see hw_range_scan_info_t. 0: not known.
struct RangeScanIntrinsics {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t layers = 0;
  double beam_rad = std::numeric_limits<double>::quiet_NaN();
  double scan_s = std::numeric_limits<double>::quiet_NaN();
};

/// Of a sensor of angular velocities and specific forces; see hw_imu_info_t.
struct ImuIntrinsics {
  double gravity_m_s2 = std::numeric_limits<double>::quiet_NaN();
  double angular_noise = std::numeric_limits<double>::quiet_NaN();
  double angular_walk = std::numeric_limits<double>::quiet_NaN();
  double force_noise = std::numeric_limits<double>::quiet_NaN();
  double force_walk = std::numeric_limits<double>::quiet_NaN();
  double max_angular_rad_s = std::numeric_limits<double>::quiet_NaN();
  double max_force_m_s2 = std::numeric_limits<double>::quiet_NaN();
};

/// Of a receiver of satellites: where on Earth the origin of its frame is; see hw_gnss_info_t.
struct GnssIntrinsics {
  double latitude_deg = std::numeric_limits<double>::quiet_NaN();
  double longitude_deg = std::numeric_limits<double>::quiet_NaN();
  double altitude_m = std::numeric_limits<double>::quiet_NaN();
};

/// Of any sensor; std::monostate: nothing is known.
using Intrinsics = std::variant<std::monostate, BumpIntrinsics, EncoderIntrinsics, RangeScanIntrinsics,
                                ImuIntrinsics, GnssIntrinsics>;

/// Most zones or wheels of a sensor.
inline constexpr std::size_t kMaxIntrinsicParts = 256;

}  // namespace hallway::host
