// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/range_scan.h>
#include <hallway/sample.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::foxglove {

// Points and rays as Foxglove takes them.

/// A number that each point has.
struct CloudField {
  enum class Type : std::uint8_t { kUint16, kUint32, kFloat32, kFloat64 };
  std::string name{};
  std::uint32_t offset = 0;  ///< in the point, bytes
  Type type = Type::kFloat32;
};

/// Points with their numbers packed one behind the other, little-endian: `x`, `y`, `z` in single precision, metres; and where they are known `intensity` in single
/// precision, NaN where it is not, `ring` in 16 bits, or in 32 where one does not fit, and `t_offset`, nanoseconds after the begin of the reading, in 32 bits
/// without a sign, or in double precision where one does not fit.
struct Cloud {
  std::vector<CloudField> fields{};
  std::uint32_t stride = 0;  ///< bytes of a point
  std::string data{};
};

/// The points of a reading, in its order.
Cloud cloud_of(const hw_points_t& points);
/// The points that the rays of a reading met, in its order.
Cloud cloud_of(const hw_range_scan_t& scan);
/// Places alone.
Cloud cloud_of(std::span<const Vec3> places);

/// A scan in the x-y plane of its sensor, with rays at equal steps.
struct LevelScan {
  double start_rad =
      0.0;  ///< azimuth of the first ray; the last one's is greater, or less where the scanner turns clockwise
  double end_rad = 0.0;
  std::vector<double>
      ranges{};  ///< as they are: infinite where nothing is in range, NaN where there is no answer
  std::vector<double> intensities{};  ///< of each ray, or empty
};

/// A reading as such a scan; nothing where its rays are not level, not at equal steps to a microradian, or have several returns.
std::optional<LevelScan> level_scan_of(const hw_range_scan_t& scan);

}  // namespace hallway::foxglove
