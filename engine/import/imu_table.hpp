// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "log/row_writer.hpp"

namespace hallway::import {

/// Largest rate [rad/s] and specific force [m/s^2] that a table of an IMU may have.
inline constexpr double kMaxImuNumber = 1e9;

/// A sample of an IMU, in its frame. SI units.
struct ImuSample {
  std::int64_t t_ns = 0;                  ///< as the file has it, not below 0
  std::array<double, 3> angular_rad_s{};  ///< rate of rotation
  std::array<double, 3> force_m_s2{};     ///< specific force: +g upward at rest
};

/// The names of the columns of a table: time in whole nanoseconds, three rates, three forces.
using ImuColumns = std::array<std::string_view, 7>;

/// Reads such a table; the header decides the order of the columns, others are passed over. Times increase. Throws Error{kBadInput} with file, line and
/// column, also for a table without rows.
std::vector<ImuSample> parse_imu_table(std::string_view text, const std::string& file,
                                       const ImuColumns& columns);

/// Adds a row with the columns in their order.
void add_row(log::RowWriter& out, const ImuSample& sample);

/// Checks a sample before it is written. Throws Error{kBadInput} with the file for a number that is not finite or beyond kMaxImuNumber, and for a time that is
/// not after `before_ns` (-1: before the first).
void check_sample(const ImuSample& sample, std::int64_t before_ns, const std::string& file);

}  // namespace hallway::import
