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

/// Occupied cells of one row without a gap, as places in the map.
struct Run {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::uint32_t set =
      0;  ///< number of the set that it hangs together with, from 1 in the order of the first cells
};

/// Adds the runs of a row.
void add_runs(const CellMap<std::uint8_t>& occupied, std::size_t begin, std::size_t end,
              std::vector<Run>& runs) {
  const std::uint8_t* cells = occupied.data();
  const auto find = [cells, end](std::size_t from, int value) {
    const void* found = std::memchr(cells + from, value, end - from);
    return found == nullptr ? end : static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - cells);
  };
  for (std::size_t at = find(begin, 1); at != end; at = find(at, 1)) {
    const std::size_t last = find(at, 0);
    runs.push_back({at, last, 0});
    at = last;
    if (at == end) break;
  }
}

/// The first run of the set that a run is in, as far as is known.
std::uint32_t first_of(std::vector<std::uint32_t>& parent, std::uint32_t run) {
  while (parent[run] != run) run = parent[run] = parent[parent[run]];
  return run;
}

/// Joins the sets of runs of two rows, one above the other, that touch over sides or corners; `shift`: cells of a row.
void join_rows(const std::vector<Run>& runs, std::size_t above, std::size_t below, std::size_t shift,
               std::vector<std::uint32_t>& parent) {
  std::size_t upper = above;
  for (std::size_t lower = below; lower < runs.size(); ++lower) {
    while (upper < below && runs[upper].end + shift < runs[lower].begin) ++upper;
    for (std::size_t k = upper; k < below && runs[k].begin + shift <= runs[lower].end; ++k) {
      const std::uint32_t one = first_of(parent, static_cast<std::uint32_t>(k));
      const std::uint32_t other = first_of(parent, static_cast<std::uint32_t>(lower));
      parent[std::max(one, other)] = std::min(one, other);
    }
  }
}

/// The runs of all rows, and the number of sets in `count`.
std::vector<Run> runs_of(const CellGrid& grid, const CellMap<std::uint8_t>& occupied, std::uint32_t& count) {
  std::vector<Run> runs;
  std::vector<std::uint32_t> parent;
  std::size_t above = 0;
  const auto columns = static_cast<std::size_t>(grid.columns);
  for (int row = 0; row < grid.rows; ++row) {
    const std::size_t below = runs.size();
    add_runs(occupied, grid.place(0, row), grid.place(0, row) + columns, runs);
    while (parent.size() < runs.size()) parent.push_back(static_cast<std::uint32_t>(parent.size()));
    join_rows(runs, above, below, columns, parent);
    above = below;
  }
  count = 0;
  for (std::uint32_t k = 0; k < runs.size(); ++k) {
    const std::uint32_t first = first_of(parent, k);
    runs[k].set = first == k ? ++count : runs[first].set;
  }
  return runs;
}

void fill(const Run& run, CellMap<std::uint8_t>& cells) {
  std::memset(&cells[run.begin], 1, run.end - run.begin);
}

/// Cells that are 0 or 1, eight at a time: `to` becomes 1 where either is, or where both are.
void combine(const std::uint8_t* from, std::uint8_t* to, std::size_t count, bool either) {
  std::size_t k = 0;
  for (; k + 8 <= count; k += 8) {
    std::uint64_t left = 0;
    std::uint64_t right = 0;
    std::memcpy(&left, from + k, 8);
    std::memcpy(&right, to + k, 8);
    right = either ? left | right : left & right;
    std::memcpy(to + k, &right, 8);
  }
  for (; k < count; ++k) to[k] = either ? (from[k] | to[k]) : (from[k] & to[k]);
}

/// Combines all stretches of `length` cells of `from` with those up to `radius` steps to both sides in the same stretch.
void combine_around(const CellMap<std::uint8_t>& from, std::size_t length, std::size_t step, int radius,
                    bool either, CellMap<std::uint8_t>& to) {
  for (std::size_t begin = 0; begin < from.size(); begin += length) {
    for (std::size_t shift = step; shift <= step * static_cast<std::size_t>(radius) && shift < length;
         shift += step) {
      combine(&from[begin], &to[begin + shift], length - shift, either);
      combine(&from[begin + shift], &to[begin], length - shift, either);
    }
  }
}

/// Cells become 1 if one within a square of `radius` cells is; or, if not `either`, if all are.
CellMap<std::uint8_t> spread(const CellGrid& grid, const CellMap<std::uint8_t>& cells, int radius,
                             bool either) {
  CellMap<std::uint8_t> along = cells;
  combine_around(cells, static_cast<std::size_t>(grid.columns), 1, radius, either, along);
  CellMap<std::uint8_t> result = along;
  combine_around(along, grid.size(), static_cast<std::size_t>(grid.columns), radius, either, result);
  return result;
}

}  // namespace

CellGrid part_of(const CellGrid& grid, const CellRange& range) {
  return {grid.low_a + range.first_column * grid.cell, grid.low_b + range.first_row * grid.cell, grid.cell,
          range.last_column - range.first_column + 1, range.last_row - range.first_row + 1};
}

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
  for (const Run& run : runs_of(grid, occupied, count)) {
    std::fill_n(&number[run.begin], run.end - run.begin, run.set);
  }
  return number;
}

CellMap<std::uint8_t> connected(const CellGrid& grid, const CellMap<std::uint8_t>& occupied,
                                const std::vector<std::size_t>& starts) {
  std::uint32_t count = 0;
  const std::vector<Run> runs = runs_of(grid, occupied, count);
  std::vector<std::uint8_t> reached(count + 1, 0);
  for (const std::size_t start : starts) {
    if (occupied[start] == 0) continue;
    const auto after = std::upper_bound(runs.begin(), runs.end(), start,
                                        [](std::size_t cell, const Run& run) { return cell < run.begin; });
    reached[(after - 1)->set] = 1;
  }
  CellMap<std::uint8_t> result(grid.size(), 0);
  for (const Run& run : runs) {
    if (reached[run.set] != 0) fill(run, result);
  }
  return result;
}

CellMap<std::uint8_t> largest_component(const CellGrid& grid, const CellMap<std::uint8_t>& occupied) {
  std::uint32_t count = 0;
  const std::vector<Run> runs = runs_of(grid, occupied, count);
  std::vector<std::size_t> sizes(count + 1, 0);
  for (const Run& run : runs) sizes[run.set] += run.end - run.begin;
  const auto largest =
      static_cast<std::uint32_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  CellMap<std::uint8_t> result(grid.size(), 0);
  for (const Run& run : runs) {
    if (run.set == largest) fill(run, result);
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
