// SPDX-License-Identifier: MIT
#include "em/core/coverage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.hpp"

namespace hallway::em {
namespace {

const Random kRandom(1, stream_id("test.em.coverage"));

CellMap<std::uint8_t> random_cells(const CellGrid& grid, std::uint32_t number, double share) {
  CellMap<std::uint8_t> cells(grid.size());
  for (std::size_t c = 0; c < cells.size(); ++c) cells[c] = kRandom.uniform(number, c) < share ? 1 : 0;
  return cells;
}

/// Calls visit(place) for the cells of the square about a cell that lie in the grid.
template <typename Visit>
void visit_square(const CellGrid& grid, int column, int row, int radius, Visit visit) {
  for (int r = std::max(row - radius, 0); r <= std::min(row + radius, grid.rows - 1); ++r) {
    for (int c = std::max(column - radius, 0); c <= std::min(column + radius, grid.columns - 1); ++c)
      visit(grid.place(c, r));
  }
}

template <typename Check>
void for_each_cell(const CellGrid& grid, Check check) {
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) check(column, row, grid.place(column, row));
  }
}

TEST(Cells, DilationAgreesWithLookingAtEachNeighbour) {
  for (std::uint32_t number = 0; number < 20; ++number) {
    const CellGrid grid{0.0, 0.0, 1.0, 1 + static_cast<int>(number) * 2,
                        1 + static_cast<int>(number * 7 % 11)};
    const CellMap<std::uint8_t> cells = random_cells(grid, number, 0.1);
    for (const int radius : {0, 1, 3}) {
      const CellMap<std::uint8_t> wide = dilated(grid, cells, radius);
      for_each_cell(grid, [&](int column, int row, std::size_t here) {
        std::uint8_t expected = 0;
        visit_square(grid, column, row, radius, [&](std::size_t c) { expected |= cells[c]; });
        ASSERT_EQ(wide[here], expected);
      });
    }
  }
}

/// The occupied cells that steps from one to the next lead to.
CellMap<std::uint8_t> walk(const CellGrid& grid, const CellMap<std::uint8_t>& cells, std::size_t start) {
  CellMap<std::uint8_t> reached(grid.size(), 0);
  std::vector<std::size_t> open{start};
  reached[start] = 1;
  while (!open.empty()) {
    const auto here = static_cast<int>(open.back());
    open.pop_back();
    visit_square(grid, here % grid.columns, here / grid.columns, 1, [&](std::size_t next) {
      if (cells[next] == 0 || reached[next] != 0) return;
      reached[next] = 1;
      open.push_back(next);
    });
  }
  return reached;
}

TEST(Cells, ComponentsAgreeWithWalkingFromCellToCell) {
  for (std::uint32_t number = 0; number < 40; ++number) {
    const CellGrid grid{0.0, 0.0, 1.0, 1 + static_cast<int>(number % 17), 1 + static_cast<int>(number / 2)};
    const CellMap<std::uint8_t> cells = random_cells(grid, number, 0.4);
    std::uint32_t count = 0;
    const CellMap<std::uint32_t> numbers = components(grid, cells, count);
    std::uint32_t seen = 0;
    std::ptrdiff_t largest = 0;
    for (std::size_t c = 0; c < grid.size(); ++c) {
      ASSERT_EQ(numbers[c] == 0, cells[c] == 0);
      if (numbers[c] <= seen) continue;
      ASSERT_EQ(numbers[c], ++seen) << "numbers are those of the order of first cells";
      const CellMap<std::uint8_t> walked = walk(grid, cells, c);
      EXPECT_EQ(connected(grid, cells, {c}), walked);
      for (std::size_t k = 0; k < grid.size(); ++k) ASSERT_EQ(walked[k] != 0, numbers[k] == seen);
      largest = std::max(largest, std::count(walked.begin(), walked.end(), 1));
    }
    EXPECT_EQ(seen, count);
    const CellMap<std::uint8_t> found = largest_component(grid, cells);
    EXPECT_EQ(std::count(found.begin(), found.end(), 1), largest);
  }
}

TEST(Coverage, MeansAgreeWithLookingAtEachNeighbour) {
  const CellGrid grid{0.0, 0.0, 1.0, 13, 9};
  CellMap<float> values(grid.size());
  for (std::size_t c = 0; c < grid.size(); ++c)
    values[c] = std::floor(static_cast<float>(kRandom.uniform(99, c, 0, 9)));
  for (const int radius : {1, 2, 20}) {
    const CellMap<float> means = mean_within(grid, values, radius);
    for_each_cell(grid, [&](int column, int row, std::size_t here) {
      double sum = 0.0;
      visit_square(grid, column, row, radius, [&](std::size_t c) { sum += static_cast<double>(values[c]); });
      ASSERT_NEAR(static_cast<double>(means[here]), sum / std::pow(2 * radius + 1, 2), 1e-5);
    });
  }
}

/// What covering each cell of a square gains, 20 cells wide in a grid of 30, where points come by chance.
CellMap<float> gain_of_square(const CellGrid& grid, double points_per_cell) {
  CellMap<float> gain(grid.size());
  for_each_cell(grid, [&](int column, int row, std::size_t here) {
    const bool inside = column >= 5 && column < 25 && row >= 5 && row < 25;
    const bool point = kRandom.uniform(7, here) < 1.0 - std::exp(-points_per_cell);
    gain[here] = inside && point ? 4.0f : -1.0f;
  });
  return gain;
}

TEST(Coverage, FillsWhatChanceLeftEmptyUpToTheBorder) {
  const CellGrid grid{0.0, 0.0, 1.0, 30, 30};
  const CellMap<std::uint8_t> covered = likely_covered(grid, gain_of_square(grid, 1.0));
  for_each_cell(grid, [&](int column, int row, std::size_t here) {
    const int outside = std::max({5 - column, column - 24, 5 - row, row - 24});
    if (outside > 0) {
      EXPECT_EQ(covered[here], 0) << column << ' ' << row;
    } else if (outside < -1) {
      EXPECT_EQ(covered[here], 1) << column << ' ' << row;
    }
  });
}

TEST(Coverage, ALonePointCoversACellOnlyIfItTellsMuch) {
  const CellGrid grid{0.0, 0.0, 1.0, 9, 9};
  CellMap<float> gain(grid.size(), -1.0f);
  gain[grid.place(4, 4)] = 2.0f;  // others explain it nearly as well
  gain[grid.place(0, 4)] = 50.0f;
  CellMap<std::uint8_t> covered = likely_covered(grid, gain);
  EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), 0);
  gain[grid.place(4, 4)] = 9.0f;
  covered = likely_covered(grid, gain);
  EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), 1);
  EXPECT_EQ(covered[grid.place(4, 4)], 1);
}

}  // namespace
}  // namespace hallway::em
