// SPDX-License-Identifier: MIT
#include "em/core/cells.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::em {
namespace {

int cells_along(double length, double cell) {
  return std::max(1, static_cast<int>(std::min(std::ceil(length / cell), 1e9)));
}

/// Calls visit(cell) for the cell and those at its sides and corners.
template <typename Visit>
void visit_neighbours(const CellGrid& grid, std::size_t cell, Visit visit) {
  const int column = static_cast<int>(cell % static_cast<std::size_t>(grid.columns));
  const int row = static_cast<int>(cell / static_cast<std::size_t>(grid.columns));
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, grid.rows - 1); ++r) {
    for (int c = std::max(column - 1, 0); c <= std::min(column + 1, grid.columns - 1); ++c) {
      visit(grid.place(c, r));
    }
  }
}

/// Sets to `value` all within `radius` of a cell of that value, along one line of `length` cells that lie
/// `stride` apart.
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

CellMap<std::uint32_t> components(const CellGrid& grid, const CellMap<std::uint8_t>& occupied,
                                  std::uint32_t& count) {
  CellMap<std::uint32_t> number(grid.size(), 0);
  count = 0;
  std::vector<std::size_t> open;
  for (std::size_t start = 0; start < grid.size(); ++start) {
    if (occupied[start] == 0 || number[start] != 0) continue;
    number[start] = ++count;
    open.push_back(start);
    while (!open.empty()) {
      const std::size_t here = open.back();
      open.pop_back();
      visit_neighbours(grid, here, [&](std::size_t next) {
        if (occupied[next] == 0 || number[next] != 0) return;
        number[next] = count;
        open.push_back(next);
      });
    }
  }
  return number;
}

CellMap<std::uint8_t> connected(const CellGrid& grid, const CellMap<std::uint8_t>& occupied,
                                const std::vector<std::size_t>& starts) {
  CellMap<std::uint8_t> reached(grid.size(), 0);
  std::vector<std::size_t> open;
  const auto reach = [&](std::size_t cell) {
    if (occupied[cell] == 0 || reached[cell] != 0) return;
    reached[cell] = 1;
    open.push_back(cell);
  };
  for (const std::size_t start : starts) reach(start);
  while (!open.empty()) {
    const std::size_t here = open.back();
    open.pop_back();
    visit_neighbours(grid, here, reach);
  }
  return reached;
}

CellMap<std::uint8_t> largest_component(const CellGrid& grid, const CellMap<std::uint8_t>& occupied) {
  std::uint32_t count = 0;
  const CellMap<std::uint32_t> number = components(grid, occupied, count);
  std::vector<std::size_t> sizes(count + 1, 0);
  for (const std::uint32_t k : number) ++sizes[k];
  sizes[0] = 0;
  const auto largest =
      static_cast<std::uint32_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  CellMap<std::uint8_t> result(grid.size(), 0);
  for (std::size_t c = 0; c < grid.size(); ++c) result[c] = largest != 0 && number[c] == largest ? 1 : 0;
  return result;
}

CellMap<std::uint8_t> dilated(const CellGrid& grid, const CellMap<std::uint8_t>& cells, int radius) {
  return spread(grid, cells, radius, 1);
}

CellMap<std::uint8_t> closed(const CellGrid& grid, const CellMap<std::uint8_t>& cells, int radius) {
  // What lies outside of the grid is no reason to erode: callers leave a margin of empty cells.
  return spread(grid, spread(grid, cells, radius, 1), radius, 0);
}

}  // namespace hallway::em
