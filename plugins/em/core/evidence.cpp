// SPDX-License-Identifier: MIT
#include "em/core/evidence.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::em {
namespace {

constexpr double kPointsForAPlane =
    3.0;  // three points make a plane: so many powers of n are tried by chance
constexpr double kFlattest = 1.0 / 16.0;  // thicker is a lump: its sides are but 14 noises long
constexpr double kFlank = 3.0;            // a flank is as thick as half of the slab times two

double outer_height(const Grown& plane) {
  return kFlank * (kSlabSigmas * plane.sigma);
}

double unclaimed_among(const std::vector<std::uint32_t>& places, const std::vector<std::uint8_t>& claimed) {
  return static_cast<double>(
      std::count_if(places.begin(), places.end(), [&claimed](std::uint32_t i) { return claimed[i] == 0; }));
}

}  // namespace

Surroundings surroundings_of(const PointField& field, const std::vector<std::uint8_t>& claimed,
                             const Grown& plane) {
  Surroundings found;
  const CellGrid& grid = plane.grid;
  SlabPoints near;
  collect(field, {plane.frame, outer_height(plane), grid.low_a, grid.high_a(), grid.low_b, grid.high_b()},
          near);
  for (std::size_t k = 0; k < near.size(); ++k) {
    if (std::abs(near.height[k]) <= kSlabSigmas * plane.sigma || claimed[near.place[k]] != 0) continue;
    if (plane.support[grid.at(near.a[k], near.b[k])] == 0) continue;
    (near.height[k] > 0.0 ? found.above : found.below).push_back(near.place[k]);
  }
  Moments moments;
  for (const std::uint32_t i : plane.members) moments.add(field.points.at(i) - plane.frame.origin);
  const Vec3 variances = moments.variances();
  found.flatness = variances[1] > 0.0 ? variances[0] / variances[1] : 1.0;
  return found;
}

Evidence evidence_of(const Surroundings& beside, const std::vector<std::uint8_t>& claimed, const Grown& plane,
                     double sigma, double volume_density) {
  const double inner = kSlabSigmas * plane.sigma;
  const double outer = outer_height(plane);
  const double above = unclaimed_among(beside.above, claimed);
  const double below = unclaimed_among(beside.below, claimed);
  const double cells = static_cast<double>(std::count(plane.support.begin(), plane.support.end(), 1));
  const double area = cells * plane.grid.cell * plane.grid.cell;
  Evidence evidence;
  evidence.members = plane.members.size();
  // A flank is as thick as the slab: (outer - inner) against 2 inner.
  evidence.background =
      std::max(std::min(above, below) * 2.0 * inner / (outer - inner), volume_density * area * 2.0 * inner);
  evidence.flatness = beside.flatness;
  evidence.noise_ratio = std::sqrt(plane.mean_square) / sigma;
  const double n = static_cast<double>(evidence.members);
  const double expected = std::max(evidence.background, 1e-3);
  evidence.gain = n > expected ? n * std::log(n / expected) - n + expected : 0.0;
  return evidence;
}

bool convincing(const Evidence& evidence, const Standard& standard, std::size_t points,
                std::size_t min_points) {
  if (evidence.members < min_points || evidence.noise_ratio > standard.noise_ratio) return false;
  const double n = static_cast<double>(evidence.members);
  return evidence.flatness <= kFlattest && evidence.background <= standard.background * n &&
         evidence.gain >= kPointsForAPlane * std::log(static_cast<double>(points));
}

}  // namespace hallway::em
