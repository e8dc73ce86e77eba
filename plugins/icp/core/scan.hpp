// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "icp/core/screw.hpp"

namespace hallway::icp {

/// Where a ray stands among those of its scan: rows are rings, columns are turned through.
struct GridPlace {
  std::uint32_t row = 0;
  std::uint32_t column = 0;
};

/// One scan: what its rays met, in the scanner's frame [m].
struct Scan {
  Points points;
  std::vector<GridPlace> places;       ///< of each point's ray
  std::vector<std::int64_t> times_ns;  ///< of each point; empty where they are not known
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  bool planar = false;  ///< whether all rays are in the x-y plane
};

/// A scan without the points that are not usable.
Scan usable_scan(const Scan& scan);

/// Places for a scan that does not tell them: rows of even steps of elevation, wide enough that none between two rings is empty, and columns of even steps of azimuth. O(n log n).
/// @param points  in the scanner's frame, as measured
std::vector<GridPlace> places_of(const Points& points);

/// Of a point about the z axis, from x towards y [rad].
inline double azimuth_of(const Vec3& p) {
  return std::atan2(p.y(), p.x());
}

}  // namespace hallway::icp
