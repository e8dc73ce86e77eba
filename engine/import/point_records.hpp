// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "import/point_collector.hpp"
#include "import/scalar.hpp"
#include "import/word_lines.hpp"

namespace hallway::import {

/// Largest file of a point cloud, and most bytes of its points once they are decompressed.
inline constexpr std::uint64_t kMaxCloudBytes = 1ull << 30;

/// Where a coordinate of the points stands.
struct Coordinate {
  bool found = false;
  Scalar type = Scalar::kFloat32;
  std::size_t word = 0;     ///< in text: its place in a point's line
  std::uint64_t begin = 0;  ///< in bytes: that of the first point
  std::uint64_t step = 0;   ///< in bytes: from point to point
};

/// x, y and z of a cloud's points.
using Coordinates = std::array<Coordinate, 3>;

/// The one that a field of this name is; null for another name.
Coordinate* coordinate_named(Coordinates& coordinates, std::string_view name);

/// Gives `count` points to `out`; every coordinate of each lies within `bytes`.
void read_binary_points(std::string_view bytes, std::uint64_t count, const Coordinates& coordinates,
                        ByteOrder order, PointCollector& out);

/// Gives `count` points of one line each to `out`. Throws Error{kBadInput} with the line for one that has not `words` words, for what is no
/// number, and where lines are missing.
void read_text_points(WordLines& lines, std::uint64_t count, std::size_t words,
                      const Coordinates& coordinates, PointCollector& out);

}  // namespace hallway::import
