// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/imu.h>
#include <hallway/magnetic.h>

#include <cstdint>
#include <string>

namespace hallway::foxglove {

// Readings for which Foxglove has no schema: JSON of plain numbers, which it plots.

inline constexpr const char* kImuSchemaName = "hallway.Imu";

/// The JSON Schema of print_imu().
std::string imu_schema();

/// A reading: `timestamp` (`sec`, `nsec`), and `x`, `y`, `z` of `angular_rad_s` and of `force_m_s2` in the sensor's frame. An axis that the sensor does not have is left out.
/// @param t_ns  the end of its interval, by the sensor's clock
std::string print_imu(std::int64_t t_ns, const hw_imu_t& imu);

inline constexpr const char* kCompassSchemaName = "hallway.Compass";

/// The JSON Schema of print_compass().
std::string compass_schema();

/// A heading: `timestamp`, `heading_rad`, `variance_rad2`. What is not known is left out.
std::string print_compass(std::int64_t t_ns, const hw_magnetic_t& magnetic);

}  // namespace hallway::foxglove
