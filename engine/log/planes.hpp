// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "log/row_writer.hpp"

namespace hallway::log {

/// A plane that a plugin found in a sample of points; sensor frame, metres.
struct Plane {
  std::uint64_t id = 0;
  std::array<double, 3> normal{};  ///< unit, towards the sensor
  double offset_m = 0.0;           ///< normal . x on the plane
  std::array<double, 3> centroid_m{};
  std::array<std::array<double, 3>, 4> corners_m{};  ///< counter-clockwise seen from where the normal points
  std::uint64_t points = 0;
  double rms_m = 0.0;
  double exclusive_share = 0.0;
};

/// One row of planes.csv.
struct IterationPlane {
  std::uint32_t iteration = 0;
  Plane plane;
};

/// A plane with what only the log has of it.
struct PlaneAnswer {
  Plane plane;
  std::vector<std::array<double, 3>> hull_m;  ///< like the corners; empty where it is not told
  std::vector<std::uint32_t> members;         ///< elements of the sample; empty where they are not told
};

/// The first line of the table.
inline constexpr std::string_view kPlaneColumns =
    "iteration,plane_id,nx,ny,nz,offset_m,cx,cy,cz,x0,y0,z0,x1,y1,z1,x2,y2,z2,x3,y3,z3,points,rms_m,"
    "exclusive_share";

/// Reads planes from CSV: the columns of kPlaneColumns in any order, iterations not decreasing. Throws Error{kBadInput} with
/// the line of the first thing that is wrong, also for a file that is cut off. O(length).
///
/// @param text  the file's content
/// @param file  its name, for messages
std::vector<IterationPlane> parse_planes(std::string_view text, const std::string& file);

/// Adds a row. Throws Error{kInternal} for a number that is not finite.
void add_row(RowWriter& out, const IterationPlane& plane);

/// The text that parse_planes() reads back to the same values. Throws Error{kInternal} for a number that is not finite.
std::string print_planes(std::span<const IterationPlane> planes);

}  // namespace hallway::log
