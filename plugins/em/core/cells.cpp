// SPDX-License-Identifier: MIT
#include "em/core/cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace hallway::em {
namespace {

int cells_along(double length, double cell) {
  return std::max(1, static_cast<int>(std::min(std::ceil(length / cell), 1e9)));
}

/// to = to or from where `grow`, else to and from; values are 0 and 1. Eight at a time: -O2 leaves such loops as
/// they are.
void combine(const std::uint8_t* from, std::uint8_t* to, int count, bool grow) {
  int k = 0;
  for (; k + 8 <= count; k += 8) {
    std::uint64_t a = 0;
    std::uint64_t b = 0;
    std::memcpy(&a, from + k, 8);
    std::memcpy(&b, to + k, 8);
    b = grow ? b | a : b & a;
    std::memcpy(to + k, &b, 8);
  }
  for (; k < count; ++k) to[k] = static_cast<std::uint8_t>(grow ? to[k] | from[k] : to[k] & from[k]);
}

/// Cells with a covered one within a square of `radius` cells become covered, or, where not `grow`, cells with
/// one that is not become uncovered. What lies outside of the grid counts for neither.
CellMap<std::uint8_t> spread(const CellGrid& grid, const CellMap<std::uint8_t>& cells, int radius,
                             bool grow) {
  CellMap<std::uint8_t> along = cells;
  for (int row = 0; row < grid.rows; ++row) {
    const std::uint8_t* from = &cells[grid.place(0, row)];
    std::uint8_t* to = &along[grid.place(0, row)];
    for (int d = 1; d <= std::min(radius, grid.columns - 1); ++d) {
      combine(from + d, to, grid.columns - d, grow);
      combine(from, to + d, grid.columns - d, grow);
    }
  }
  CellMap<std::uint8_t> result = along;
  for (int row = 0; row < grid.rows; ++row) {
    for (int r = std::max(row - radius, 0); r <= std::min(row + radius, grid.rows - 1); ++r) {
      combine(&along[grid.place(0, r)], &result[grid.place(0, row)], grid.columns, grow);
    }
  }
  return result;
}

/// Occupied cells of a row, side by side: columns [begin, end).
struct Run {
  int row = 0, begin = 0, end = 0;
  std::uint32_t first = 0;  ///< a run before it that it hangs together with, or itself
};

std::uint32_t root_of(std::vector<Run>& runs, std::uint32_t k) {
  while (runs[k].first != k) {
    runs[k].first = runs[runs[k].first].first;
    k = runs[k].first;
  }
  return k;
}

/// All runs, row by row; those that hang together have one root, the first of them.
std::vector<Run> runs_of(const CellGrid& grid, const CellMap<std::uint8_t>& occupied) {
  std::vector<Run> runs;
  std::size_t above = 0;  // the first run of the row above that may touch the next one of this row
  for (int row = 0; row < grid.rows; ++row) {
    const std::uint8_t* cells = &occupied[grid.place(0, row)];
    const std::size_t begin_of_row = runs.size();
    for (int c = 0; c < grid.columns; ++c) {
      if (cells[c] == 0) continue;
      const int begin = c;
      while (c < grid.columns && cells[c] != 0) ++c;
      const auto here = static_cast<std::uint32_t>(runs.size());
      runs.push_back({row, begin, c, here});
      while (above < begin_of_row && (runs[above].row < row - 1 || runs[above].end < begin)) ++above;
      for (std::size_t k = above; k < begin_of_row && runs[k].begin <= c; ++k) {
        const std::uint32_t a = root_of(runs, static_cast<std::uint32_t>(k));
        const std::uint32_t b = root_of(runs, here);
        runs[std::max(a, b)].first = std::min(a, b);
      }
    }
    above = std::max(above, std::min(begin_of_row, runs.size()));
  }
  return runs;
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
  std::vector<Run> runs = runs_of(grid, occupied);
  std::vector<std::uint32_t> numbers(runs.size(), 0);
  count = 0;
  for (std::uint32_t k = 0; k < runs.size(); ++k) {
    const std::uint32_t root = root_of(runs, k);
    numbers[k] = root == k ? ++count : numbers[root];
    const auto begin = number.begin() + static_cast<std::ptrdiff_t>(grid.place(runs[k].begin, runs[k].row));
    std::fill_n(begin, runs[k].end - runs[k].begin, numbers[k]);
  }
  return number;
}

CellMap<std::uint8_t> connected(const CellGrid& grid, const CellMap<std::uint8_t>& occupied,
                                const std::vector<std::size_t>& starts) {
  std::uint32_t count = 0;
  const CellMap<std::uint32_t> number = components(grid, occupied, count);
  std::vector<std::uint8_t> chosen(count + 1, 0);
  for (const std::size_t start : starts) chosen[number[start]] = 1;
  chosen[0] = 0;
  CellMap<std::uint8_t> reached(grid.size());
  for (std::size_t c = 0; c < grid.size(); ++c) reached[c] = chosen[number[c]];
  return reached;
}

CellMap<std::uint8_t> largest_component(const CellGrid& grid, const CellMap<std::uint8_t>& occupied) {
  CellMap<std::uint8_t> result(grid.size(), 0);
  std::vector<Run> runs = runs_of(grid, occupied);
  if (runs.empty()) return result;
  std::vector<int> sizes(runs.size(), 0);
  for (std::uint32_t k = 0; k < runs.size(); ++k) sizes[root_of(runs, k)] += runs[k].end - runs[k].begin;
  const auto largest =
      static_cast<std::uint32_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  for (std::uint32_t k = 0; k < runs.size(); ++k) {
    if (root_of(runs, k) != largest) continue;
    const auto begin = result.begin() + static_cast<std::ptrdiff_t>(grid.place(runs[k].begin, runs[k].row));
    std::fill_n(begin, runs[k].end - runs[k].begin, std::uint8_t{1});
  }
  return result;
}

CellMap<std::uint8_t> dilated(const CellGrid& grid, const CellMap<std::uint8_t>& cells, int radius) {
  return spread(grid, cells, radius, true);
}

CellMap<std::uint8_t> closed(const CellGrid& grid, const CellMap<std::uint8_t>& cells, int radius) {
  // What lies outside of the grid is no reason to erode: callers leave a margin of empty cells.
  return spread(grid, spread(grid, cells, radius, true), radius, false);
}

}  // namespace hallway::em
