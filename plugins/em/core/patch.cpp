// SPDX-License-Identifier: MIT
#include "em/core/patch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hallway::em {
namespace {

constexpr double kPointsPerPatchCell =
    1.0;  // fine enough to follow a border to about the spacing of the points ...
constexpr double kPatchCellSigmas = 1.0;  // ... but not finer than the noise
constexpr int kMargin = 3;  // cells around what is covered, so that closing and widening find room

CellGrid with_margin(double low_a, double high_a, double low_b, double high_b, double cell) {
  const double margin = kMargin * cell;
  return grid_over(low_a - margin, high_a + margin, low_b - margin, high_b + margin, cell, kMostCells);
}

void cover(Patch& patch, const CellMap<std::uint8_t>& support) {
  const auto value = static_cast<float>(std::log(patch.density));
  const CellMap<std::uint8_t> wide = dilated(patch.grid, closed(patch.grid, support, 1), 1);
  patch.log_density.assign(patch.grid.size(), kNotCovered);
  for (std::size_t c = 0; c < wide.size(); ++c) {
    if (wide[c] != 0) patch.log_density[c] = value;
  }
}

void mark(const Patch& from, const Patch& to, CellMap<std::uint8_t>& support) {
  visit_cells(from, [&](const Vec3& middle) {
    const Vec2 at = to.frame.flat(middle);
    support[to.grid.at(at.x(), at.y())] = 1;
  });
}

}  // namespace

double log_peak(double sigma) {
  constexpr double kLogRootTwoPi = 0.9189385332046727;
  return -std::log(sigma) - kLogRootTwoPi;
}

Slab slab_over(const Patch& patch, double sigmas) {
  const CellGrid& grid = patch.grid;
  return {patch.frame, sigmas * patch.sigma, grid.low_a, grid.high_a(), grid.low_b, grid.high_b()};
}

Patch patch_of(const Grown& grown) {
  const CellGrid& old = grown.grid;
  Patch patch;
  patch.frame = grown.frame;
  patch.sigma = grown.sigma;
  patch.level = grown.sigma;
  const auto cells = static_cast<double>(std::count(grown.support.begin(), grown.support.end(), 1));
  patch.density = static_cast<double>(grown.members.size()) / (cells * old.cell * old.cell);
  return restricted(patch, old, grown.support, patch.density);
}

Patch restricted(const Patch& patch, const CellGrid& old, const CellMap<std::uint8_t>& marked,
                 double density) {
  Patch result = patch;
  result.density = density;
  const double cell = std::max(std::sqrt(kPointsPerPatchCell / density), kPatchCellSigmas * patch.sigma);
  result.grid = with_margin(old.low_a, old.high_a(), old.low_b, old.high_b(), cell);
  CellMap<std::uint8_t> support(result.grid.size(), 0);
  for (int row = 0; row < result.grid.rows; ++row) {
    for (int column = 0; column < result.grid.columns; ++column) {
      const Vec2 at = result.grid.middle(column, row);
      if (old.contains(at)) support[result.grid.place(column, row)] = marked[old.at(at.x(), at.y())];
    }
  }
  cover(result, support);
  return result;
}

bool touching(const Patch& left, const Patch& right) {
  bool found = false;
  visit_cells(right, [&](const Vec3& middle) { found = found || left.covers(left.frame.flat(middle)); });
  return found;
}

Patch joined(const Patch& left, const Patch& right, const PlaneFrame& frame) {
  Eigen::AlignedBox2d bounds;
  for (const Patch* patch : {&left, &right})
    visit_cells(*patch, [&](const Vec3& middle) { bounds.extend(frame.flat(middle)); });
  Patch patch;
  patch.frame = frame;
  patch.sigma = std::max(left.sigma, right.sigma);
  patch.level = std::max(left.level, right.level);
  patch.density = std::max(left.density, right.density);
  patch.grid = with_margin(bounds.min().x(), bounds.max().x(), bounds.min().y(), bounds.max().y(),
                           std::max(left.grid.cell, right.grid.cell));
  CellMap<std::uint8_t> support(patch.grid.size(), 0);
  mark(left, patch, support);
  mark(right, patch, support);
  cover(patch, support);
  return patch;
}

Patch denser(const Patch& patch, double factor) {
  Patch result = patch;
  result.density *= factor;
  for (float& value : result.log_density) {
    if (value != kNotCovered) value += static_cast<float>(std::log(factor));
  }
  return result;
}

void crop(Patch& patch, const CellRange& range) {
  const CellGrid old = patch.grid;
  patch.grid = part_of(old, range);
  CellMap<float> kept(patch.grid.size());
  for (int row = 0; row < patch.grid.rows; ++row) {
    const float* first = &patch.log_density[old.place(range.first_column, range.first_row + row)];
    std::copy(first, first + patch.grid.columns, &kept[patch.grid.place(0, row)]);
  }
  patch.log_density = std::move(kept);
}

}  // namespace hallway::em
