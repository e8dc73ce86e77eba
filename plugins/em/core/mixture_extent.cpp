// SPDX-License-Identifier: MIT
// Where patches reach: Mixture::cover() and Mixture::split().
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "em/core/coverage.hpp"
#include "em/core/mixture.hpp"

namespace hallway::em {
namespace {

constexpr double kLeastDensity = 0.1;  // of a patch's density: in cells of few or no points
constexpr int kNearbyCells = 2;        // to either side: the points there tell the density of a cell
constexpr double kOneSided = 4.0;      // log likelihood by which one side leads as good as alone
constexpr int kMargin = 2;             // cells: the outermost ones are never covered
constexpr double kGapSpacings =
    1.6;  // half of the gap that chance leaves within a patch, in spacings of points
constexpr double kSeamSigmas = 3.0;  // half of the gap that a patch that crosses it leaves
constexpr double kGrowth =
    0.15;  // of the smaller side: how far beyond the old border a new one is looked for
constexpr double kMarginSigmas = 4.0;
constexpr double kMarginCells = 4.0;

CellRange range_of(const CellGrid& grid, const CellMap<std::uint8_t>& cells) {
  CellRange range;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      if (cells[grid.place(column, row)] != 0) range.extend(column, row);
    }
  }
  return range;
}

/// Logs of densities, most of which are the largest one there can be.
class LogDensity {
 public:
  explicit LogDensity(double most)
      : most_(static_cast<float>(most)), log_most_(static_cast<float>(std::log(most))) {}
  float operator()(float density) const { return density >= most_ ? log_most_ : std::log(density); }

 private:
  float most_, log_most_;
};

/// Points per area within the support. Where the patch has it only because a gap was closed, others took its
/// points: there the density is taken to be as it was.
double density_within(const CellGrid& grid, const CellMap<std::uint8_t>& support,
                      const CellMap<std::uint8_t>& occupied, const CellMap<float>& own, double before) {
  const double area = grid.cell * grid.cell;
  double points = 0.0;
  double cells = 0.0;
  for (std::size_t c = 0; c < grid.size(); ++c) {
    if (support[c] == 0) continue;
    cells += 1.0;
    points += occupied[c] != 0 ? static_cast<double>(own[c]) : before * area;
  }
  return cells > 0.0 && points > 0.0 ? points / (cells * area) : before;
}

int cells_for(double length, const CellGrid& grid) {
  return static_cast<int>(std::ceil(length / grid.cell));
}

/// The patch's grid with room for the patch to grow.
CellGrid widened(const Patch& patch) {
  const CellGrid& old = patch.grid;
  const double margin = kMarginCells * old.cell + kMarginSigmas * patch.sigma +
                        kGrowth * std::min(old.high_a() - old.low_a, old.high_b() - old.low_b);
  return grid_over(old.low_a - margin, old.high_a() + margin, old.low_b - margin, old.high_b() + margin,
                   old.cell, kMostCells);
}

/// What the log likelihood of a point grows by where a patch may have made it too, of a score that is greater by
/// `lead` than the point's best one without.
double gain_of(double lead) {
  if (std::abs(lead) > kOneSided) return std::max(lead, 0.0);
  return std::log1p(std::exp(lead));
}

/// Sets the log density of all cells of `support`: what is counted there, at most that of the whole patch and
/// at least a little; in closed gaps that of the whole patch.
void set_densities(Patch& patch, const CellMap<float>& own, const CellMap<std::uint8_t>& support,
                   const CellMap<std::uint8_t>& likely) {
  const CellGrid& grid = patch.grid;
  const auto per_area = static_cast<float>(1.0 / (grid.cell * grid.cell));
  const auto most = static_cast<float>(patch.density);
  const auto least = static_cast<float>(kLeastDensity * patch.density);
  const LogDensity log_density(patch.density);
  const CellMap<float> around = mean_within(grid, own, 1);
  patch.log_density.assign(grid.size(), kNotCovered);
  for (std::size_t c = 0; c < grid.size(); ++c) {
    if (support[c] == 0) continue;
    const float there = std::max(own[c], around[c]) * per_area;
    patch.log_density[c] = log_density(likely[c] == 0 ? most : std::clamp(there, least, most));
  }
}

/// Covers `support` of the patch's grid, at the density of the points there.
void take_support(Patch& patch, const CellMap<float>& own, const CellMap<std::uint8_t>& support,
                  const CellMap<std::uint8_t>& likely) {
  patch.density = density_within(patch.grid, support, likely, own, patch.density);
  set_densities(patch, own, support, likely);
  const CellRange range = range_of(patch.grid, support);
  if (!range.empty()) crop(patch, range);
}

/// Cells of a patch's grid: its points, what it may cover, the largest part of that which hangs together, and
/// what is likely covered.
struct Cover {
  const CellMap<float>& own;
  const CellMap<std::uint8_t>& covered;
  const CellMap<std::uint8_t>& largest;
  const CellMap<std::uint8_t>& likely;
};

/// Adds a patch for each other part with `least` points of the patch.
void add_pieces(const Patch& patch, const Cover& cover, std::size_t least, std::vector<Patch>& pieces) {
  std::uint32_t count = 0;
  const CellMap<std::uint32_t> number = components(patch.grid, cover.covered, count);
  std::vector<double> points(count + 1, 0.0);
  for (std::size_t c = 0; c < number.size(); ++c) {
    if (cover.largest[c] == 0) points[number[c]] += static_cast<double>(cover.own[c]);
  }
  for (std::uint32_t n = 1; n <= count; ++n) {
    if (points[n] < static_cast<double>(least)) continue;
    CellMap<std::uint8_t> support(number.size());
    for (std::size_t c = 0; c < number.size(); ++c) support[c] = number[c] == n ? 1 : 0;
    pieces.push_back(patch);
    take_support(pieces.back(), cover.own, support, cover.likely);
  }
}

}  // namespace

void Mixture::crop_to_points(std::uint32_t j, int margin, SlabPoints& slab) {
  CellGrid& grid = patches[j].grid;
  const auto column_of = [&grid](double a) { return static_cast<int>((a - grid.low_a) / grid.cell); };
  const auto row_of = [&grid](double b) { return static_cast<int>((b - grid.low_b) / grid.cell); };
  CellRange range;
  for (std::size_t k = 0; k < slab.size(); ++k) {
    const std::uint32_t label = best_[slab.place[k]];
    if (label != j && label != kNoPlane) continue;
    range.extend(column_of(slab.a[k]), row_of(slab.b[k]));
  }
  if (range.empty()) return;
  const CellRange wide{
      std::max(range.first_column - margin, 0), std::min(range.last_column + margin, grid.columns - 1),
      std::max(range.first_row - margin, 0), std::min(range.last_row + margin, grid.rows - 1)};
  std::size_t kept = 0;
  for (std::size_t k = 0; k < slab.size(); ++k) {
    if (!wide.contains(column_of(slab.a[k]), row_of(slab.b[k]))) continue;
    slab.place[kept] = slab.place[k];
    slab.a[kept] = slab.a[k];
    slab.b[kept] = slab.b[k];
    slab.height[kept++] = slab.height[k];
  }
  slab.resize(kept);
  grid = part_of(grid, wide);
}

CellMap<float> Mixture::own_points(std::uint32_t j, Scratch& scratch, CellMap<float>& density) const {
  const CellGrid& grid = patches[j].grid;
  CellMap<float> own(grid.size(), 0.0f);
  CellMap<float> open(grid.size(), 0.0f);
  const SlabPoints& slab = scratch.slab;
  scratch.cells.resize(slab.size());
  for (std::size_t k = 0; k < slab.size(); ++k) {
    const std::uint32_t label = best_[slab.place[k]];
    const std::size_t c = grid.at(slab.a[k], slab.b[k]);
    scratch.cells[k] = c;
    if (label != j && label != kNoPlane) continue;
    open[c] += 1.0f;
    if (label == j) own[c] += 1.0f;
  }
  density = mean_within(grid, open, kNearbyCells);
  const double area = grid.cell * grid.cell;
  const auto most = static_cast<float>(patches[j].density);
  const auto least = static_cast<float>(kLeastDensity * patches[j].density);
  for (float& value : density) value = std::clamp(value / static_cast<float>(area), least, most);
  return own;
}

CellMap<float> Mixture::cell_gains(std::uint32_t j, const Scratch& scratch,
                                   const CellMap<float>& density) const {
  const Patch& patch = patches[j];
  const CellGrid& grid = patch.grid;
  // Points come one by one (Poisson): covering a cell costs the number of points to be expected there.
  CellMap<float> gain(grid.size());
  const auto area = static_cast<float>(grid.cell * grid.cell);
  for (std::size_t c = 0; c < grid.size(); ++c) gain[c] = -density[c] * area;
  const double peak = log_peak(patch.sigma);
  const double scale = -0.5 / (patch.sigma * patch.sigma);
  const SlabPoints& slab = scratch.slab;
  const LogDensity log_density(patch.density);
  for (std::size_t k = 0; k < slab.size(); ++k) {
    const std::uint32_t i = slab.place[k];
    const std::size_t c = scratch.cells[k];
    const double score =
        static_cast<double>(log_density(density[c])) + peak + scale * slab.height[k] * slab.height[k];
    const float without = best_[i] == j ? second_score_[i] : best_score_[i];
    gain[c] += static_cast<float>(gain_of(score - static_cast<double>(without)));
  }
  return gain;
}

void Mixture::cover_patch(std::uint32_t j, std::size_t least_piece, Scratch& scratch,
                          std::vector<Patch>& pieces) {
  Patch& patch = patches[j];
  patch.grid = widened(patch);
  const CellGrid& grid = patch.grid;
  collect(field_, slab_over(patch, kSlabSigmas), scratch.slab);
  const int gap = std::max(cells_for(kGapSpacings / std::sqrt(patch.density), grid),
                           cells_for(kSeamSigmas * patch.sigma, grid) + 1);
  crop_to_points(j, gap + kMargin, scratch.slab);
  CellMap<float> density;
  const CellMap<float> own = own_points(j, scratch, density);
  const CellMap<std::uint8_t> likely = likely_covered(grid, cell_gains(j, scratch, density));
  const CellMap<std::uint8_t> covered = closed(grid, likely, gap);
  const CellMap<std::uint8_t> largest = largest_component(grid, covered);
  if (least_piece > 0) add_pieces(patch, {own, covered, largest, likely}, least_piece, pieces);
  take_support(patch, own, largest, likely);
}

void Mixture::cover(std::size_t least_piece) {
  std::vector<std::vector<Patch>> pieces(patches.size());
  workers_.run(patches.size(), [&](std::size_t j, std::size_t worker) {
    cover_patch(static_cast<std::uint32_t>(j), least_piece, scratch_[worker], pieces[j]);
  });
  for (std::vector<Patch>& of_one : pieces)
    std::move(of_one.begin(), of_one.end(), std::back_inserter(patches));
}

std::vector<Patch> Mixture::parts_of(std::uint32_t j, std::size_t min_points, SlabPoints& slab) const {
  const Patch& patch = patches[j];
  const CellGrid& old = patch.grid;
  const double cell = std::max(std::sqrt(kPointsPerCell / patch.density), kSlabSigmas * patch.sigma);
  const CellGrid grid = grid_over(old.low_a, old.high_a(), old.low_b, old.high_b(), cell, kMostCells);
  collect(field_, slab_over(patch, kSlabSigmas), slab);
  CellMap<std::uint8_t> occupied(grid.size(), 0);
  for (std::size_t k = 0; k < slab.size(); ++k) {
    if (patch.log_density[old.at(slab.a[k], slab.b[k])] == kNotCovered) continue;
    occupied[grid.at(slab.a[k], slab.b[k])] = 1;  // whosever it is: what crosses the patch does not cut it
  }
  std::uint32_t count = 0;
  const CellMap<std::uint32_t> number = components(grid, occupied, count);
  std::vector<std::size_t> own(count + 1, 0);
  std::vector<std::size_t> cells(count + 1, 0);
  for (std::size_t k = 0; k < slab.size(); ++k) {
    if (best_[slab.place[k]] == j) ++own[number[grid.at(slab.a[k], slab.b[k])]];
  }
  for (const std::uint32_t n : number) ++cells[n];
  own[0] = 0;
  if (std::count_if(own.begin(), own.end(), [min_points](std::size_t n) { return n >= min_points; }) < 2)
    return {};
  std::vector<Patch> parts;
  for (std::uint32_t n = 1; n <= count; ++n) {
    if (own[n] < min_points) continue;
    CellMap<std::uint8_t> support(grid.size(), 0);
    for (std::size_t c = 0; c < grid.size(); ++c) support[c] = number[c] == n ? 1 : 0;
    const double area = static_cast<double>(cells[n]) * grid.cell * grid.cell;
    parts.push_back(restricted(patch, grid, support, static_cast<double>(own[n]) / area));
  }
  return parts;
}

bool Mixture::split(std::size_t min_points) {
  std::vector<std::vector<Patch>> parts(patches.size());
  workers_.run(patches.size(), [&](std::size_t j, std::size_t worker) {
    parts[j] = parts_of(static_cast<std::uint32_t>(j), min_points, scratch_[worker].slab);
  });
  std::vector<Patch> after;
  bool any = false;
  for (std::size_t j = 0; j < patches.size(); ++j) {
    any = any || !parts[j].empty();
    if (parts[j].empty()) parts[j].push_back(std::move(patches[j]));
    std::move(parts[j].begin(), parts[j].end(), std::back_inserter(after));
  }
  patches = std::move(after);
  return any;
}

}  // namespace hallway::em
