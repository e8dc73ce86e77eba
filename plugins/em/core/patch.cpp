// SPDX-License-Identifier: MIT
#include "em/core/patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// Middle of a cell in space.
Vec3 middle_of(const PlaneFrame& frame, const CellGrid& grid, int column, int row) {
  return frame.origin + (grid.low_a + (column + 0.5) * grid.cell) * frame.u +
         (grid.low_b + (row + 0.5) * grid.cell) * frame.v;
}

/// Calls visit(middle) for each cell that the patch covers.
template <typename Visit>
void visit_cells(const Patch& patch, Visit visit) {
  for (int row = 0; row < patch.grid.rows; ++row) {
    for (int column = 0; column < patch.grid.columns; ++column) {
      if (patch.log_density[patch.grid.place(column, row)] == kNotCovered) continue;
      visit(middle_of(patch.frame, patch.grid, column, row));
    }
  }
}

struct Reach {
  double low_a = std::numeric_limits<double>::infinity();
  double low_b = low_a;
  double high_a = -low_a;
  double high_b = -low_a;
};

void widen(Reach& bounds, const PlaneFrame& frame, const Patch& patch) {
  visit_cells(patch, [&](const Vec3& middle) {
    const double a = frame.u.dot(middle - frame.origin);
    const double b = frame.v.dot(middle - frame.origin);
    bounds.low_a = std::min(bounds.low_a, a);
    bounds.high_a = std::max(bounds.high_a, a);
    bounds.low_b = std::min(bounds.low_b, b);
    bounds.high_b = std::max(bounds.high_b, b);
  });
}

void mark(const Patch& from, const PlaneFrame& frame, const CellGrid& grid, CellMap<std::uint8_t>& support) {
  visit_cells(from, [&](const Vec3& middle) {
    support[grid.at(frame.u.dot(middle - frame.origin), frame.v.dot(middle - frame.origin))] = 1;
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
      const double a = result.grid.low_a + (column + 0.5) * result.grid.cell;
      const double b = result.grid.low_b + (row + 0.5) * result.grid.cell;
      if (a < old.low_a || b < old.low_b || a > old.high_a() || b > old.high_b()) continue;
      support[result.grid.place(column, row)] = marked[old.at(a, b)];
    }
  }
  cover(result, support);
  return result;
}

bool touching(const Patch& left, const Patch& right) {
  const CellGrid& grid = left.grid;
  bool found = false;
  visit_cells(right, [&](const Vec3& middle) {
    const double a = left.frame.u.dot(middle - left.frame.origin);
    const double b = left.frame.v.dot(middle - left.frame.origin);
    if (found || a < grid.low_a || b < grid.low_b || a > grid.high_a() || b > grid.high_b()) return;
    found = left.log_density[grid.at(a, b)] != kNotCovered;
  });
  return found;
}

Patch joined(const Patch& left, const Patch& right, const PlaneFrame& frame) {
  Reach bounds;
  widen(bounds, frame, left);
  widen(bounds, frame, right);
  Patch patch;
  patch.frame = frame;
  patch.sigma = std::max(left.sigma, right.sigma);
  patch.level = std::max(left.level, right.level);
  patch.density = std::max(left.density, right.density);
  patch.grid = with_margin(bounds.low_a, bounds.high_a, bounds.low_b, bounds.high_b,
                           std::max(left.grid.cell, right.grid.cell));
  CellMap<std::uint8_t> support(patch.grid.size(), 0);
  mark(left, frame, patch.grid, support);
  mark(right, frame, patch.grid, support);
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

void crop(Patch& patch, int first_column, int last_column, int first_row, int last_row) {
  const CellGrid old = patch.grid;
  patch.grid = {old.low_a + first_column * old.cell, old.low_b + first_row * old.cell, old.cell,
                last_column - first_column + 1, last_row - first_row + 1};
  CellMap<float> kept(patch.grid.size());
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      kept[patch.grid.place(column - first_column, row - first_row)] =
          patch.log_density[old.place(column, row)];
    }
  }
  patch.log_density = std::move(kept);
}

}  // namespace hallway::em
