// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "em/core/types.hpp"

namespace hallway::em {

/// One value for each cell, row by row.
template <typename Value>
using CellMap = std::vector<Value>;

/// Square cells over a rectangle of a plane.
struct CellGrid {
  double low_a = 0.0, low_b = 0.0;  ///< corner of the first cell
  double cell = 1.0;                ///< side
  int columns = 0, rows = 0;

  std::size_t size() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  double high_a() const { return low_a + cell * columns; }
  double high_b() const { return low_b + cell * rows; }
  /// Whether (a, b) lies inside of the rectangle or on its border.
  bool contains(const Vec2& at) const {
    return at.x() >= low_a && at.y() >= low_b && at.x() <= high_a() && at.y() <= high_b();
  }
  Vec2 middle(int column, int row) const {
    return {low_a + (column + 0.5) * cell, low_b + (row + 0.5) * cell};
  }
  /// Cell of (a, b), which must lie inside of the rectangle or on its border.
  std::size_t at(double a, double b) const {
    const int column = static_cast<int>((a - low_a) / cell);
    const int row = static_cast<int>((b - low_b) / cell);
    return place(column < columns ? column : columns - 1, row < rows ? row : rows - 1);
  }
  /// Place of a cell in a CellMap.
  std::size_t place(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/// Rectangle of cells, ends included; empty at first.
struct CellRange {
  int first_column = std::numeric_limits<int>::max(), last_column = -1;
  int first_row = first_column, last_row = -1;

  bool empty() const { return last_column < first_column; }
  bool contains(int column, int row) const {
    return column >= first_column && column <= last_column && row >= first_row && row <= last_row;
  }
  void extend(int column, int row) {
    first_column = std::min(first_column, column);
    last_column = std::max(last_column, column);
    first_row = std::min(first_row, row);
    last_row = std::max(last_row, row);
  }
};

/// The grid of a range of the cells of another.
CellGrid part_of(const CellGrid& grid, const CellRange& range);

/// The grid over the rectangle with the cells asked for, or larger ones where there would be more than
/// `most`.
CellGrid grid_over(double low_a, double high_a, double low_b, double high_b, double cell, std::size_t most);

/// The occupied cells that hang together, over sides and corners, with an occupied one of `starts`.
CellMap<std::uint8_t> connected(const CellGrid& grid, const CellMap<std::uint8_t>& occupied,
                                const std::vector<std::size_t>& starts);

/// The largest set of occupied cells that hang together (the first one of equals).
CellMap<std::uint8_t> largest_component(const CellGrid& grid, const CellMap<std::uint8_t>& occupied);

/// Numbers the sets of occupied cells that hang together, from 1 in the order of their first cells; 0: not
/// occupied.
CellMap<std::uint32_t> components(const CellGrid& grid, const CellMap<std::uint8_t>& occupied,
                                  std::uint32_t& count);

/// `cells` and all within `radius` cells of one (a square).
CellMap<std::uint8_t> dilated(const CellGrid& grid, const CellMap<std::uint8_t>& cells, int radius);

/// `cells` with gaps up to 2 `radius` cells wide filled: dilated, then eroded.
CellMap<std::uint8_t> closed(const CellGrid& grid, const CellMap<std::uint8_t>& cells, int radius);

}  // namespace hallway::em
