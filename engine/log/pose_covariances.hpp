// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "log/row_writer.hpp"

namespace hallway::log {

/// The upper triangle, by rows, of the covariance of a pose's error: position x, y, z [m], then rotation vector x, y, z [rad],
/// both in the map's frame.
using PoseCovariance = std::array<double, 21>;

/// How sure a plugin was of the pose of an iteration.
struct IterationCovariance {
  std::uint32_t iteration = 0;
  PoseCovariance covariance{};
};

/// The first line of the table.
inline constexpr std::string_view kPoseCovarianceColumns =
    "iteration,xx,xy,xz,xa,xb,xc,yy,yz,ya,yb,yc,zz,za,zb,zc,aa,ab,ac,bb,bc,cc";

/// The upper triangle of a 6 x 6 matrix given by rows.
PoseCovariance upper_triangle(const std::array<double, 36>& matrix);

/// Adds a row. Throws Error{kInternal} for a number that is not finite.
void add_row(RowWriter& out, const IterationCovariance& row);

}  // namespace hallway::log
