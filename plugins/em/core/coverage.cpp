// SPDX-License-Identifier: MIT
#include "em/core/coverage.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace hallway::em {
namespace {

// Log likelihood of two neighbours, of eight, that agree against two that differ. Less leaves borders ragged
// where points are few, more rounds corners off.
constexpr float kAgreement = 0.6f;
constexpr int kSweeps = 4;  // nearly nothing changes after the second

/// Sums of 2 `radius` + 1 values about each of `length` values.
void sum_along(const float* from, float* to, int length, int radius) {
  float sum = 0.0f;
  for (int k = 0; k < std::min(radius, length); ++k) sum += from[k];
  for (int k = 0; k < length; ++k) {
    if (k + radius < length) sum += from[k + radius];
    to[k] = sum;
    if (k >= radius) sum -= from[k - radius];
  }
}

void add(const float* from, float* to, int length, float sign) {
  for (int k = 0; k < length; ++k) to[k] += sign * from[k];
}

/// Which cells are covered, and how many of the nine at and about each.
class Covered {
 public:
  /// At first where `gain` is positive, but not at the border of the grid.
  Covered(const CellGrid& grid, const CellMap<float>& gain)
      : columns_(static_cast<std::size_t>(grid.columns)), cells_(grid.size(), 0), nine_(grid.size(), 0) {
    CellMap<std::uint8_t> along(grid.size(), 0);
    for (int row = 1; row + 1 < grid.rows; ++row) {
      const std::size_t begin = grid.place(1, row);
      const std::size_t end = grid.place(grid.columns - 1, row);
      for (std::size_t c = begin; c < end; ++c) cells_[c] = gain[c] > 0.0f ? 1 : 0;
      for (std::size_t c = begin; c < end; ++c) {
        along[c] = static_cast<std::uint8_t>(cells_[c - 1] + cells_[c] + cells_[c + 1]);
      }
    }
    for (std::size_t c = columns_; c + columns_ < grid.size(); ++c) {
      nine_[c] = static_cast<std::uint8_t>(along[c - columns_] + along[c] + along[c + columns_]);
    }
  }

  void turn(std::size_t cell) {
    const int step = cells_[cell] != 0 ? -1 : 1;
    cells_[cell] ^= 1;
    for (const std::size_t row : {cell - columns_, cell, cell + columns_}) {
      for (const std::size_t c : {row - 1, row, row + 1})
        nine_[c] = static_cast<std::uint8_t>(nine_[c] + step);
    }
  }
  bool at(std::size_t cell) const { return cells_[cell] != 0; }
  /// Of the eight about it.
  int around(std::size_t cell) const { return nine_[cell] - cells_[cell]; }
  CellMap<std::uint8_t> cells() && { return std::move(cells_); }

 private:
  std::size_t columns_;
  CellMap<std::uint8_t> cells_, nine_;
};

}  // namespace

CellMap<float> mean_within(const CellGrid& grid, const CellMap<float>& values, int radius) {
  CellMap<float> along(values.size());
  CellMap<float> result(values.size());
  for (int row = 0; row < grid.rows; ++row) {
    sum_along(&values[grid.place(0, row)], &along[grid.place(0, row)], grid.columns, radius);
  }
  const auto side = static_cast<float>(2 * radius + 1);
  CellMap<float> sums(static_cast<std::size_t>(grid.columns), 0.0f);  // over the rows about the present one
  const auto add_row = [&](int row, float sign) {
    if (row >= 0 && row < grid.rows) add(&along[grid.place(0, row)], sums.data(), grid.columns, sign);
  };
  for (int row = 0; row < radius; ++row) add_row(row, 1.0f);
  for (int row = 0; row < grid.rows; ++row) {
    add_row(row + radius, 1.0f);
    add(sums.data(), &result[grid.place(0, row)], grid.columns, 1.0f / (side * side));
    add_row(row - radius, -1.0f);
  }
  return result;
}

CellMap<std::uint8_t> likely_covered(const CellGrid& grid, const CellMap<float>& gain) {
  Covered covered(grid, gain);
  const auto sweep_row = [&](int row) {
    bool any = false;
    const std::size_t begin = grid.place(1, row);
    const std::size_t end = grid.place(grid.columns - 1, row);
    for (std::size_t c = begin; c < end; ++c) {
      const bool now = gain[c] > kAgreement * static_cast<float>(8 - 2 * covered.around(c));
      if (now == covered.at(c)) continue;
      covered.turn(c);
      any = true;
    }
    return any;
  };
  std::vector<std::uint8_t> changed(static_cast<std::size_t>(grid.rows), 1);  // rows in the sweep before
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    std::vector<std::uint8_t> next(changed.size(), 0);
    for (int row = 1; row + 1 < grid.rows; ++row) {
      const auto r = static_cast<std::size_t>(row);
      const bool touched = (changed[r - 1] | changed[r] | changed[r + 1] | next[r - 1]) != 0;
      if (touched && sweep_row(row)) next[r] = 1;
    }
    changed = std::move(next);
  }
  return std::move(covered).cells();
}

}  // namespace hallway::em
