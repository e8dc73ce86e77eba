// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::sense {

/// Ranges of rays that have none: nothing is in range; there is no answer.
inline constexpr double kNothing_m = std::numeric_limits<double>::infinity();
inline constexpr double kUnanswered_m = std::numeric_limits<double>::quiet_NaN();

/// A beam of a scanner: where it points in the sensor's frame (x forward, y left, z up), and when.
struct PatternRay {
  double azimuth_rad = 0.0;    ///< from x towards y
  double elevation_rad = 0.0;  ///< above the x-y plane
  double share = 0.0;          ///< of the scan's duration that has passed when it is measured, in [0, 1)
  std::uint32_t ring = 0;      ///< that measures it
};

/// The way of a beam: unit, in the sensor's frame.
Vec3 direction_of(const PatternRay& ray);

/// The beams of one scan.
struct RayPattern {
  std::vector<PatternRay> rays{};
  /// Of an organised scan columns (moments) and rows (rings): ray row * width + column. 0 and 0: it is not organised.
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// Most beams of a scan.
inline constexpr std::size_t kMostRays = std::size_t{1} << 20;

/// A scanner that turns about z at a constant rate, one turn a scan, all rings at once. Column c looks at azimuth from + c * step; it measures in the
/// order of the columns, and the way back to the first one belongs to the scan: column c is measured after |c * step| / 2 pi of it.
struct SpinSpec {
  double from_rad = -3.14159265358979323846;  ///< azimuth of the first column, within a turn of 0
  double step_rad =
      3.14159265358979323846 / 900;         ///< from column to column, not 0; negative: it turns clockwise
  std::uint32_t columns = 1800;             ///< at least 1; together at most one turn
  std::vector<double> elevations_rad{0.0};  ///< of each ring, within a quarter turn of 0; at least one
};

/// The beams of such a scanner. Throws Error{kBadInput} that names the member for what is out of range, and for more than kMostRays.
RayPattern spinning_pattern(const SpinSpec& spec);

/// Elevations of rings at equal steps, both ends included; one ring is at their middle.
std::vector<double> equal_elevations(double lowest_rad, double highest_rad, std::uint32_t rings);

/// Throws Error{kBadInput} for a pattern without rays, with too many, with angles, shares or sizes out of range.
void check_pattern(const RayPattern& pattern);

}  // namespace hallway::sense
