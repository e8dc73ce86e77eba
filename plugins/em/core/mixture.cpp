// SPDX-License-Identifier: MIT
#include "em/core/mixture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <cstdio>
#include <cstdlib>

namespace hallway::em {
namespace {

constexpr double kLogRootTwoPi = 0.9189385332046727;
constexpr double kFarthest = 4.5;         // standard deviations: beyond no point is a plane's, whatever the density
constexpr double kClearlyBest = 4.0;      // log likelihood by which the best must lead to be a patch's own
constexpr double kRim = 0.1;              // density at the rim of a patch by that within, at least
constexpr double kOccupied = 0.2;         // of the median density: a cell with less of its own is no part
const double RS=getenv("RS")?atof(getenv("RS")):1.0;
constexpr int kClosing = 2;               // cells; gaps where another plane crosses are closed
constexpr double kPriorPoints = 20.0;     // weight of the cloud's noise in a patch's own
constexpr double kNoiseLeeway = 1.4;      // a patch's noise against that of the cloud
constexpr double kParameters = 8.0;       // of a finite plane: three of the plane, four of its extent, its noise
constexpr double kMergedNoise = 1.15;     // RMS of a joined patch by that of its parts
constexpr double kMergeCosine = 0.9;      // planes farther turned are not compared
constexpr std::uint32_t kNone = kNoPlane;

float median_of(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Median of the cells with points, per area; at least what all points over all cells give
double typical_density(const CellMap<float>& counts, double cell) {
  std::vector<float> filled;
  for (const float count : counts) {
    if (count > 0.0f) filled.push_back(count);
  }
  if (filled.empty()) return 0.0;
  return static_cast<double>(median_of(filled)) / (cell * cell);
}

/// Mean of a cell and its eight neighbours.
double mean_around(const CellGrid& grid, const CellMap<float>& counts, int column, int row) {
  double sum = 0.0;
  for (int r = row - 1; r <= row + 1; ++r) {
    for (int c = column - 1; c <= column + 1; ++c) {
      if (c >= 0 && r >= 0 && c < grid.columns && r < grid.rows) sum += static_cast<double>(counts[grid.place(c, r)]);
    }
  }
  return sum / 9.0;
}

}  // namespace

Mixture::Mixture(const PointField& field, double volume, double sigma)
    : field_(&field), volume_(volume), sigma_(sigma), unassigned_(field.points.count) {
  const std::size_t n = field.points.blocks() * kBlockSize;
  best_.assign(n, kNone);
  second_.assign(n, kNone);
  best_score_.assign(n, 0.0f);
  second_score_.assign(n, 0.0f);
}

double Mixture::outliers_per_volume() const {
  return (static_cast<double>(unassigned_) + 0.5) / volume_;
}

double Mixture::log_outlier() const {
  return std::log(outliers_per_volume());
}

void Mixture::add(const Grown& grown) {
  patches.push_back(patch_of(grown));
}

void Mixture::assign() {
  const auto outlier = static_cast<float>(log_outlier());
  std::fill(best_.begin(), best_.end(), kNone);
  std::fill(second_.begin(), second_.end(), kNone);
  std::fill(best_score_.begin(), best_score_.end(), outlier);
  std::fill(second_score_.begin(), second_score_.end(), outlier);
  for (std::uint32_t j = 0; j < patches.size(); ++j) {
    const Patch& patch = patches[j];
    const CellGrid& grid = patch.grid;
    const double peak = -std::log(patch.sigma) - kLogRootTwoPi;
    const double lead = 2.0 * (std::log(patch.density) + peak - static_cast<double>(outlier));
    if (!(lead > 0.0)) continue;
    const double reach = std::min(std::sqrt(lead), kFarthest) * patch.sigma;
    collect(*field_, {patch.frame, reach, grid.low_a, grid.high_a(), grid.low_b, grid.high_b()}, slab_);
    const double scale = -0.5 / (patch.sigma * patch.sigma);
    for (std::size_t k = 0; k < slab_.size(); ++k) {
      const float density = patch.log_density[grid.at(slab_.a[k], slab_.b[k])];
      if (density == kNotSupported) continue;
      const auto score = density + static_cast<float>(peak + scale * slab_.height[k] * slab_.height[k]);
      const std::uint32_t i = slab_.place[k];
      if (score > best_score_[i]) {
        second_[i] = best_[i];
        second_score_[i] = best_score_[i];
        best_[i] = j;
        best_score_[i] = score;
      } else if (score > second_score_[i]) {
        second_[i] = j;
        second_score_[i] = score;
      }
    }
  }
  unassigned_ = 0;
  for (std::size_t i = 0; i < field_->points.count; ++i) unassigned_ += best_[i] == kNone ? 1 : 0;
}

void Mixture::refit() {
  std::vector<Moments> moments(patches.size());
  const double outlier = log_outlier();
  for (std::size_t i = 0; i < field_->points.count; ++i) {
    const std::uint32_t j = best_[i];
    if (j == kNone) continue;
    const Vec3 p = field_->points.at(i);
    const double best = static_cast<double>(best_score_[i]);
    double rest = 0.0;
    double other = 0.0;
    if (best - outlier < 7.0) rest = std::exp(outlier - best);
    if (second_[i] != kNone) other = std::exp(static_cast<double>(second_score_[i]) - best);
    const double share = 1.0 / (1.0 + rest + other);
    moments[j].add(p - patches[j].frame.origin, share);
    if (other * share > 0.01) moments[second_[i]].add(p - patches[second_[i]].frame.origin, other * share);
  }
  for (std::size_t j = 0; j < patches.size(); ++j) {
    if (moments[j].weight() < 4.0) continue;
    Patch& patch = patches[j];
    const PlaneFit fit = moments[j].fit(patch.frame.origin);
    const Vec3 kept = patch.frame.origin;
    patch.frame = turned(patch.frame, fit.frame.normal);
    patch.frame.origin = kept + patch.frame.normal * patch.frame.normal.dot(fit.frame.origin - kept);
    const double weight = moments[j].weight();
    const double variance =
        (weight * fit.variances[0] + kPriorPoints * sigma_ * sigma_) / (weight - 3.0 + kPriorPoints);
    patch.sigma = std::clamp(std::sqrt(variance), sigma_ / kNoiseLeeway, sigma_ * kNoiseLeeway);
  }
  if (patches.size() < 1) return;
  std::vector<float> sigmas;
  for (const Patch& patch : patches) sigmas.push_back(static_cast<float>(patch.sigma));
  sigma_ = static_cast<double>(median_of(sigmas));
}

void Mixture::cover_patch(std::uint32_t j) {
  Patch& patch = patches[j];
  const CellGrid old = patch.grid;
  const double margin = 4.0 * old.cell + 4.0 * patch.sigma + 0.15 * std::min(old.high_a() - old.low_a, old.high_b() - old.low_b);
  const CellGrid grid = grid_over(old.low_a - margin, old.high_a() + margin, old.low_b - margin, old.high_b() + margin,
                                  old.cell, std::numeric_limits<std::size_t>::max());
  collect(*field_, {patch.frame, kSlabSigmas * patch.sigma, grid.low_a, grid.high_a(), grid.low_b, grid.high_b()}, slab_);
  CellMap<float> own(grid.size(), 0.0f);       // points clearly its own
  CellMap<float> all(grid.size(), 0.0f);       // points given to it
  CellMap<float> free(grid.size(), 0.0f);      // given to none
  for (std::size_t k = 0; k < slab_.size(); ++k) {
    const std::uint32_t i = slab_.place[k];
    if (best_[i] == kNone) {
      free[grid.at(slab_.a[k], slab_.b[k])] += 1.0f;
    } else if (best_[i] == j) {
      const std::size_t cell = grid.at(slab_.a[k], slab_.b[k]);
      all[cell] += 1.0f;
      if (second_[i] == kNone || static_cast<double>(best_score_[i] - second_score_[i]) > kClearlyBest) own[cell] += 1.0f;
    }
  }
  const double area = grid.cell * grid.cell;
  static const double CS=getenv("CS")?atof(getenv("CS")):1.6, RR=getenv("RR")?atof(getenv("RR")):0.8, CW=getenv("CW")?atof(getenv("CW")):3.0;
  const double spacing = 1.0/std::sqrt(patch.density);
  const int closing = std::max(static_cast<int>(std::ceil(CS*spacing/grid.cell)), static_cast<int>(std::ceil(CW * patch.sigma / grid.cell)) + 1);
  const int ring = std::max(static_cast<int>(std::lround(RR*spacing/grid.cell)), static_cast<int>(std::ceil(RS * patch.sigma / grid.cell)));
  const auto enough = static_cast<float>(std::max(1.0, kOccupied * patch.density * area));
  CellMap<std::uint8_t> occupied(grid.size(), 0);
  for (std::size_t c = 0; c < grid.size(); ++c) occupied[c] = own[c] + free[c] >= enough ? 1 : 0;
  CellMap<std::uint8_t> support = largest_component(grid, closed(grid, occupied, closing));
  const CellMap<std::uint8_t> rim = dilated(grid, support, ring);
  double inside=0.0, covered=0.0;
  for (std::size_t c=0;c<grid.size();++c) if (support[c]) { covered+=1.0; if (occupied[c]) inside += static_cast<double>(all[c]); else inside += patch.density*area;}
  if (covered>0.0 && inside>0.0) patch.density = inside/(covered*area);
  // cut to what is covered
  int c0 = grid.columns, c1 = -1, r0 = grid.rows, r1 = -1;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      if (rim[grid.place(column, row)] == 0) continue;
      c0 = std::min(c0, column);
      c1 = std::max(c1, column);
      r0 = std::min(r0, row);
      r1 = std::max(r1, row);
    }
  }
  if (c1 < c0) {
    patch.log_density.assign(patch.grid.size(), kNotSupported);
    return;
  }
  CellGrid cut{grid.low_a + c0 * grid.cell, grid.low_b + r0 * grid.cell, grid.cell, c1 - c0 + 1, r1 - r0 + 1};
  CellMap<float> log_density(cut.size(), kNotSupported);
  for (int row = r0; row <= r1; ++row) {
    for (int column = c0; column <= c1; ++column) {
      const std::size_t cell = grid.place(column, row);
      if (rim[cell] == 0) continue;
      double local = std::max(static_cast<double>(all[cell]), mean_around(grid, all, column, row)) / area;
      local = std::max(local, kRim * patch.density);
      if (support[cell] != 0 && occupied[cell] == 0) local = patch.density;
      log_density[cut.place(column - c0, row - r0)] = static_cast<float>(std::log(std::min(local, patch.density)));
    }
  }
  patch.grid = cut;
  patch.log_density = std::move(log_density);
}

void Mixture::cover() {
  for (std::uint32_t j = 0; j < patches.size(); ++j) cover_patch(j);
}

bool Mixture::cull(std::size_t min_points) {
  std::vector<double> gain(patches.size(), 0.0);
  std::vector<std::size_t> members(patches.size(), 0);
  for (std::size_t i = 0; i < field_->points.count; ++i) {
    if (best_[i] == kNone) continue;
    gain[best_[i]] += static_cast<double>(best_score_[i] - second_score_[i]);
    ++members[best_[i]];
  }
  const double cost = 0.5 * kParameters * std::log(static_cast<double>(field_->points.count));
  // One at a time, the least first: what it leaves may make another one worth its cost.
  std::size_t worst = patches.size();
  for (std::size_t j = 0; j < patches.size(); ++j) {
    const bool poor = members[j] < min_points || gain[j] < cost;
    if (poor && (worst == patches.size() || gain[j] < gain[worst])) worst = j;
  }
  if (worst == patches.size()) return false;
  patches.erase(patches.begin() + static_cast<std::ptrdiff_t>(worst));
  return true;
}

bool Mixture::merge() {
  if (patches.size() < 2) return false;
  std::vector<Moments> moments(patches.size());
  for (std::size_t i = 0; i < field_->points.count; ++i) {
    if (best_[i] != kNone) moments[best_[i]].add(field_->points.at(i));
  }
  bool merged = false;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    for (std::size_t j = i + 1; j < patches.size(); ++j) {
      if (moments[i].weight() < 4.0 || moments[j].weight() < 4.0) continue;
      if (std::abs(patches[i].frame.normal.dot(patches[j].frame.normal)) < kMergeCosine) continue;
      if (!touching(patches[i], patches[j])) continue;
      Moments joint = moments[i];
      joint.join(moments[j]);
      const double parts = (moments[i].weight() * moments[i].fit(Vec3::Zero()).variances[0] +
                            moments[j].weight() * moments[j].fit(Vec3::Zero()).variances[0]) /
                           joint.weight();
      const PlaneFit fit = joint.fit(Vec3::Zero());
      if (fit.variances[0] > kMergedNoise * kMergedNoise * std::max(parts, 0.5 * sigma_ * sigma_)) continue;
      if (getenv("D")) fprintf(stderr,"merge %zu %zu: %.0f %.0f rms %.4f parts %.4f\n",i,j,moments[i].weight(),moments[j].weight(),std::sqrt(fit.variances[0]),std::sqrt(parts));
      patches[i] = joined(patches[i], patches[j], fit.frame);
      moments[i] = joint;
      moments.erase(moments.begin() + static_cast<std::ptrdiff_t>(j));
      patches.erase(patches.begin() + static_cast<std::ptrdiff_t>(j));
      merged = true;
      --j;
    }
  }
  return merged;
}

}  // namespace hallway::em
