// SPDX-License-Identifier: MIT
#include "em/core/seeds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "em/core/neighbours.hpp"
#include "geometry/median.hpp"

namespace hallway::em {
namespace {

// A plane takes three degrees of freedom, so k points leave k - 3 to tell the noise; fewer than 12 tell too
// little.
constexpr std::array<std::size_t, 7> kScales{12, 18, 27, 40, 60, 90, 128};
constexpr double kOnALine = 1e-6;  // smaller by larger variance along the plane: no plane follows from it
constexpr double kFlatEnough =
    0.01;  // the normal is then known to a hundredth over 100 points: look no wider
constexpr std::size_t kThinning = 4;                 // of a coarser level: half the density along an edge
constexpr std::size_t kFewest = 400;                 // points of the coarsest level
constexpr double kGoldenRatio = 0.6180339887498949;  // its multiples, modulo 1, lie apart from each other
constexpr std::size_t kBestShare = 4;                // the best quarter tells the noise
constexpr double kNarrow = 0.125;  // of the median radius of the flatter half: narrower ones do not tell it

/// A level of the cloud: every 4^l-th point.
struct Level {
  Points points;
  BoxTree tree;
};

Points thinned(const Points& points) {
  Points result;
  result.resize((points.count + kThinning - 1) / kThinning);
  for (std::size_t i = 0; i < result.count; ++i) result.set(i, points.at(i * kThinning));
  return result;
}

std::vector<Level> levels_of(const Points& points, Workers& workers) {
  std::vector<Level> levels;
  levels.push_back({points, BoxTree(points, workers)});
  while (levels.back().points.count / kThinning >= kFewest) {
    Points coarser = thinned(levels.back().points);
    BoxTree tree(coarser, workers);
    levels.push_back({std::move(coarser), std::move(tree)});
  }
  return levels;
}

/// The scale at which the neighbourhood is flattest, and how flat.
struct BestScale {
  Moments moments;
  std::size_t count = 0;
  double flatness = 0.0;
  double noise = 0.0;
  double radius = 0.0;
};

std::optional<BestScale> best_scale(const Points& points, const std::vector<NearPoint>& near,
                                    const Vec3& middle) {
  std::optional<BestScale> best;
  Moments moments;
  std::size_t next = 0;
  for (std::size_t k = 1; k <= near.size(); ++k) {
    moments.add(points.at(near[k - 1].place) - middle);
    if (next == kScales.size() || k != kScales[next]) continue;
    ++next;
    const Vec3 variances = moments.variances();
    if (!(variances[1] > kOnALine * variances[2])) continue;
    const double unbiased = variances[0] * static_cast<double>(k) / static_cast<double>(k - 3);
    const double flatness = unbiased / variances[1];
    if (best && flatness >= best->flatness) continue;
    best = BestScale{moments, k, flatness, std::sqrt(unbiased), std::sqrt(near[k - 1].squared_distance)};
  }
  return best;
}

/// Radius to look for neighbours of a point in: about that of its block, for half of the blocks have fewer
/// within.
double radius_guess(const BoxTree& tree, std::size_t place) {
  return 1.5 * tree.block_box(place / kBlockSize).half.norm();
}

Seed seed_from(const BestScale& scale, std::uint32_t place, const Vec3& middle, double thinning) {
  Seed seed;
  seed.place = place;
  const PlaneFit fit = scale.moments.fit(middle);
  seed.frame = fit.frame;
  seed.radius = scale.radius;
  seed.density =
      thinning * static_cast<double>(scale.count) / (std::numbers::pi * scale.radius * scale.radius);
  seed.noise = scale.noise;
  seed.flatness = scale.flatness;
  return seed;
}

/// Looks at ever coarser levels while the flattest neighbourhood is the widest one: then the noise is large
/// against the spacing, and a wider one may be flatter still.
std::optional<Seed> seed_at(const std::vector<Level>& levels, std::uint32_t place,
                            std::vector<NearPoint>& near) {
  const Vec3 middle = levels.front().points.at(place);
  std::optional<Seed> seed;
  double thinning = 1.0;
  std::size_t index = place;
  for (const Level& level : levels) {
    nearest({level.points, level.tree}, middle, kScales.back(), radius_guess(level.tree, index), near);
    const std::optional<BestScale> scale = best_scale(level.points, near, middle);
    if (scale && (!seed || scale->flatness < seed->flatness))
      seed = seed_from(*scale, place, middle, thinning);
    const bool wider = scale && scale->count >= kScales[kScales.size() - 2] && scale->flatness > kFlatEnough;
    if (!wider) break;
    thinning *= static_cast<double>(kThinning);
    index /= kThinning;
  }
  return seed;
}

/// The seed of `seeds` (at least one) with the median noise.
Seed with_median_noise(std::vector<Seed> seeds) {
  return median(seeds, [](const Seed& left, const Seed& right) { return left.noise < right.noise; });
}

/// The first of `seeds` that are at least so wide, up to `most`.
std::vector<Seed> first_wide(const std::vector<Seed>& seeds, double radius, std::size_t most) {
  std::vector<Seed> wide;
  for (const Seed& seed : seeds) {
    if (seed.radius >= radius && wide.size() < most) wide.push_back(seed);
  }
  return wide;
}

}  // namespace

std::vector<Seed> find_seeds(const Points& points, std::size_t wanted, std::size_t round, Workers& workers) {
  std::vector<Seed> seeds;
  if (points.count < kScales.front()) return seeds;
  const std::vector<Level> levels = levels_of(points, workers);
  const std::size_t tries = std::min(wanted, points.count);
  const double shift = std::fmod(0.5 + kGoldenRatio * static_cast<double>(round), 1.0);
  std::vector<std::optional<Seed>> tried(tries);
  std::vector<std::vector<NearPoint>> near(workers.count());
  workers.run(tries, [&](std::size_t k, std::size_t worker) {
    const double part = (static_cast<double>(k) + shift) / static_cast<double>(tries);
    const auto place = static_cast<std::uint32_t>(part * static_cast<double>(points.count));
    tried[k] = seed_at(levels, place, near[worker]);
  });
  for (const std::optional<Seed>& seed : tried) {
    if (seed) seeds.push_back(*seed);
  }
  std::sort(seeds.begin(), seeds.end(), [](const Seed& left, const Seed& right) {
    return left.flatness != right.flatness ? left.flatness < right.flatness : left.place < right.place;
  });
  return seeds;
}

double noise_of_seeds(const std::vector<Seed>& seeds) {
  if (seeds.empty()) return 0.0;
  const std::size_t best = (seeds.size() + kBestShare - 1) / kBestShare;
  const Seed among_all = with_median_noise(first_wide(seeds, 0.0, best));
  std::vector<double> radii;
  for (std::size_t k = 0; k < (seeds.size() + 1) / 2; ++k) radii.push_back(seeds[k].radius);
  const double narrowest = kNarrow * median(radii);
  if (among_all.radius >= narrowest) return among_all.noise;
  return with_median_noise(first_wide(seeds, narrowest, best)).noise;
}

}  // namespace hallway::em
