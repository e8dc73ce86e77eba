// SPDX-License-Identifier: MIT
#include "em/core/growth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/median.hpp"

namespace hallway::em {
namespace {

constexpr double kWiden =
    std::numbers::sqrt2;  // of the radius: the area doubles, so all steps together cost twice the last
constexpr int kMaxSteps = 60;
constexpr std::size_t kFewest = 4;  // points that make a fit
constexpr double kSettled = 1.02;   // growth of the number of members below which the plane is complete ...
constexpr int kSettledSteps = 2;    // ... when it happens so often in a row
constexpr double kHopeless =
    1.5;  // RMS by noise at which the slab is as full outside as within: no plane ...
constexpr int kHopelessSteps = 3;  // ... after so many steps
// A surface that bends fills the slab where it goes on: it is then taken up to where it was flat.
constexpr double kBent = 1.3;            // RMS by noise at least
constexpr double kFlat = 1.1;            // RMS by noise at most ...
constexpr std::size_t kFewestFlat = 50;  // ... of so many points at least
constexpr double kDense = 1.5;      // cells with more than so many times the median are thinned by weight
constexpr double kMostCells = 4.0;  // cells per point of the slab at most

std::uint16_t median_count(const CellMap<std::uint16_t>& counts, std::vector<std::uint16_t>& sorted) {
  sorted.clear();
  for (const std::uint16_t count : counts) {
    if (count > 0) sorted.push_back(count);
  }
  return sorted.empty() ? std::uint16_t{0} : median(sorted);
}

/// Area that `cells` square cells cover, those at the border by half.
double covered_area(std::size_t cells, double cell) {
  const double side = std::max(1.0, std::sqrt(static_cast<double>(cells)) - 0.8);
  return side * side * cell * cell;
}

}  // namespace

void Grower::take_slab(double radius) {
  Slab slab{plane_.frame, kSlabSigmas * plane_.sigma, -radius, radius, -radius, radius};
  collect(field_, slab, slab_);
  if (slab_.size() == 0) return;
  double low_a = std::numeric_limits<double>::infinity();
  double low_b = low_a;
  double high_a = -low_a;
  double high_b = -low_a;
  for (std::size_t k = 0; k < slab_.size(); ++k) {
    low_a = std::min(low_a, slab_.a[k]);
    high_a = std::max(high_a, slab_.a[k]);
    low_b = std::min(low_b, slab_.b[k]);
    high_b = std::max(high_b, slab_.b[k]);
  }
  const auto most = static_cast<std::size_t>(kMostCells * static_cast<double>(slab_.size())) + 64;
  plane_.grid = grid_over(low_a, high_a, low_b, high_b, cell_, most);
}

void Grower::spread_over_cells(double seed_radius) {
  const CellGrid& grid = plane_.grid;
  CellMap<std::uint8_t> occupied(grid.size(), 0);
  std::vector<std::size_t> starts;
  cell_of_.resize(slab_.size());
  for (std::size_t k = 0; k < slab_.size(); ++k) {
    const double a = slab_.a[k];
    const double b = slab_.b[k];
    cell_of_[k] = grid.at(a, b);
    occupied[cell_of_[k]] = 1;
    if (a * a + b * b <= seed_radius * seed_radius) starts.push_back(cell_of_[k]);
  }
  plane_.support = connected(grid, occupied, starts);
  counts_.assign(grid.size(), 0);
  picked_.clear();
  for (std::size_t k = 0; k < slab_.size(); ++k) {
    if (plane_.support[cell_of_[k]] == 0 || claimed_[slab_.place[k]] != 0) continue;
    picked_.push_back(static_cast<std::uint32_t>(k));
    plane_.relied_on.push_back(slab_.place[k]);
    if (counts_[cell_of_[k]] < 0xffff) ++counts_[cell_of_[k]];
  }
}

void Grower::refit() {
  std::vector<std::uint16_t> sorted;
  const double full = kDense * median_count(counts_, sorted);
  Moments moments;
  for (const std::uint32_t k : picked_) {
    const double count = counts_[cell_of_[k]];
    const Vec3 from = field_.points.at(slab_.place[k]) - plane_.frame.origin;
    // Tukey's biweight: of two surfaces in the slab the fit keeps to the one that it is on.
    const double away = slab_.height[k] / (kSlabSigmas * plane_.sigma);
    const double inner = std::max(0.0, 1.0 - away * away);
    moments.add(from, inner * inner * (count > full ? full / count : 1.0));
  }
  const PlaneFit fit = moments.fit(plane_.frame.origin);
  // The origin stays where the seed is, moved onto the new plane, so that the growth goes on from there.
  const Vec3 seed = plane_.frame.origin;
  plane_.frame = turned(plane_.frame, fit.frame.normal);
  plane_.frame.origin = seed + plane_.frame.normal * plane_.frame.normal.dot(fit.frame.origin - seed);
}

double Grower::mean_square() const {
  double squares = 0.0;
  for (const std::uint32_t k : picked_) squares += slab_.height[k] * slab_.height[k];
  return picked_.empty() ? 0.0 : squares / static_cast<double>(picked_.size());
}

Grown Grower::grow(const Seed& seed, double sigma) {
  double flat = 0.0;
  return grow_within(seed, sigma, std::numeric_limits<double>::infinity(), flat);
}

Grown Grower::grow_flat(const Seed& seed, double sigma) {
  double flat = 0.0;
  Grown grown = grow_within(seed, sigma, std::numeric_limits<double>::infinity(), flat);
  if (grown.mean_square <= kBent * kBent * sigma * sigma || !(flat > 0.0)) return grown;
  Grown within = grow_within(seed, sigma, flat, flat);
  within.relied_on.insert(within.relied_on.end(), grown.relied_on.begin(), grown.relied_on.end());
  return within;
}

Grown Grower::grow_within(const Seed& seed, double sigma, double widest, double& flat) {
  plane_ = Grown{};
  plane_.frame = frame_on(seed.frame.origin, seed.frame.normal);
  plane_.sigma = sigma;
  cell_ = std::max(std::sqrt(kPointsPerCell / seed.density), kSlabSigmas * sigma);
  const double first_cell = cell_;
  double radius = seed.radius;
  std::size_t members = 0;
  int settled = 0;
  for (int step = 0; step < kMaxSteps && settled < kSettledSteps; ++step) {
    picked_.clear();
    take_slab(radius);
    if (slab_.size() == 0) break;
    spread_over_cells(seed.radius);
    if (picked_.size() < kFewest) break;
    refit();
    const double count = static_cast<double>(picked_.size());
    if (picked_.size() >= kFewestFlat && mean_square() <= kFlat * kFlat * sigma * sigma) flat = radius;
    if (step >= kHopelessSteps && mean_square() > kHopeless * kHopeless * sigma * sigma) break;
    settled = count <= kSettled * static_cast<double>(members) ? settled + 1 : 0;
    members = picked_.size();
    const auto cells = static_cast<std::size_t>(std::count(plane_.support.begin(), plane_.support.end(), 1));
    cell_ = std::clamp(std::sqrt(kPointsPerCell * covered_area(cells, plane_.grid.cell) / count),
                       first_cell / 2.0, first_cell * 2.0);
    cell_ = std::max(cell_, kSlabSigmas * sigma);
    if (settled == 0 && radius * kWiden > widest) break;
    if (settled == 0) radius *= kWiden;
  }
  for (const std::uint32_t k : picked_) plane_.members.push_back(slab_.place[k]);
  plane_.mean_square = mean_square();
  return std::move(plane_);
}

}  // namespace hallway::em
