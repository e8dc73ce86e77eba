// SPDX-License-Identifier: MIT
#include "em/core/cells.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::em {
namespace {

int cells_along(double length, double cell) {
  return std::max(1, static_cast<int>(std::min(std::ceil(length / cell), 1e9)));
}

/// Marks everything connected with `start` in `reached`; returns how many cells it marked.
std::size_t flood(const CellGrid& grid, const CellMap<std::uint8_t>& occupied, std::size_t start,
                  CellMap<std::uint8_t>& reached) {
  std::vector<std::size_t> open{start};
  reached[start] = 1;
  std::size_t marked = 0;
  while (!open.empty()) {
    const std::size_t here = open.back();
    open.pop_back();
    ++marked;
    const int column = static_cast<int>(here % static_cast<std::size_t>(grid.columns));
    const int row = static_cast<int>(here / static_cast<std::size_t>(grid.columns));
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, grid.rows - 1); ++r) {
      for (int c = std::max(column - 1, 0); c <= std::min(column + 1, grid.columns - 1); ++c) {
        const std::size_t next = grid.place(c, r);
        if (occupied[next] == 0 || reached[next] != 0) continue;
        reached[next] = 1;
        open.push_back(next);
      }
    }
  }
  return marked;
}

/// Sets to `value` all within `radius` of a cell of that value, along one line of `length` cells that lie `stride` apart.
void spread_line(const std::uint8_t* from, std::uint8_t* to, int length, std::ptrdiff_t stride, int radius,
                 std::uint8_t value) {
  int last = -radius - 1;  // the last cell of that value seen so far
  for (int k = 0; k < length + radius; ++k) {
    if (k < length && from[k * stride] == value) last = k;
    const int here = k - radius;
    if (here < 0) continue;
    to[here * stride] = last >= here - radius ? value : from[here * stride];
  }
}

/// Cells with one of `value` within a square of `radius` cells become `value` themselves.
CellMap<std::uint8_t> spread(const CellGrid& grid, const CellMap<std::uint8_t>& cells, int radius,
                             std::uint8_t value) {
  CellMap<std::uint8_t> along(cells.size());
  CellMap<std::uint8_t> result(cells.size());
  for (int row = 0; row < grid.rows; ++row) {
    const std::size_t begin = grid.place(0, row);
    spread_line(&cells[begin], &along[begin], grid.columns, 1, radius, value);
  }
  for (int column = 0; column < grid.columns; ++column) {
    const std::size_t begin = grid.place(column, 0);
    spread_line(&along[begin], &result[begin], grid.rows, grid.columns, radius, value);
  }
  return result;
}

}  // namespace

CellGrid grid_over(double low_a, double high_a, double low_b, double high_b, double cell, std::size_t most) {
  CellGrid grid{low_a, low_b, cell, cells_along(high_a - low_a, cell), cells_along(high_b - low_b, cell)};
  while (static_cast<double>(grid.columns) * grid.rows > static_cast<double>(most)) {
    grid.cell *= 1.5;
    grid.columns = cells_along(high_a - low_a, grid.cell);
    grid.rows = cells_along(high_b - low_b, grid.cell);
  }
  return grid;
}

CellMap<std::uint8_t> connected(const CellGrid& grid, const CellMap<std::uint8_t>& occupied,
                                const std::vector<std::size_t>& starts) {
  CellMap<std::uint8_t> reached(grid.size(), 0);
  for (const std::size_t start : starts) {
    if (occupied[start] != 0 && reached[start] == 0) flood(grid, occupied, start, reached);
  }
  return reached;
}

CellMap<std::uint8_t> largest_component(const CellGrid& grid, const CellMap<std::uint8_t>& occupied) {
  CellMap<std::uint8_t> reached(grid.size(), 0);
  std::size_t best_start = grid.size();
  std::size_t best_count = 0;
  for (std::size_t start = 0; start < grid.size(); ++start) {
    if (occupied[start] == 0 || reached[start] != 0) continue;
    const std::size_t count = flood(grid, occupied, start, reached);
    if (count <= best_count) continue;
    best_count = count;
    best_start = start;
  }
  if (best_start == grid.size()) return reached;
  return connected(grid, occupied, {best_start});
}

CellMap<std::uint8_t> dilated(const CellGrid& grid, const CellMap<std::uint8_t>& cells, int radius) {
  return spread(grid, cells, radius, 1);
}

CellMap<std::uint8_t> closed(const CellGrid& grid, const CellMap<std::uint8_t>& cells, int radius) {
  // What lies outside of the grid is no reason to erode: callers leave a margin of empty cells.
  return spread(grid, spread(grid, cells, radius, 1), radius, 0);
}

}  // namespace hallway::em
