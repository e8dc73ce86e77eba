// SPDX-License-Identifier: MIT
#include "em/core/auto_planes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <chrono>

#include "em/core/canonical.hpp"
#include "em/core/evidence.hpp"
#include "em/core/growth.hpp"
#include "em/core/mixture.hpp"
#include "em/core/seeds.hpp"

namespace hallway::em {
namespace {
struct Timer { const char* n; std::chrono::steady_clock::time_point t=std::chrono::steady_clock::now(); explicit Timer(const char*a):n(a){} ~Timer(){ if (getenv("T")) fprintf(stderr,"%s %.3f ms\n",n,std::chrono::duration<double,std::milli>(std::chrono::steady_clock::now()-t).count());} };

Points unclaimed(const Points& points, const std::vector<std::uint8_t>& claimed, std::vector<std::uint32_t>& places) {
  places.clear();
  for (std::size_t i = 0; i < points.count; ++i) {
    if (claimed[i] == 0) places.push_back(static_cast<std::uint32_t>(i));
  }
  Points result;
  result.resize(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) result.set(k, points.at(places[k]));
  return result;
}

double volume_of(const Vec3& extent, double sigma) {
  return extent.cwiseMax(20.0 * sigma).prod();
}
}  // namespace

/// Seeds, growth and acceptance until two rounds give nothing; claims what it accepts. Returns number of planes found.
static std::size_t peel(const PointField& field, const AutoOptions& options, std::vector<std::uint8_t>& claimed, double volume, Mixture& mixture, const std::vector<Seed>* first) {
  std::size_t found = 0;
  int fruitless = 0;
  std::vector<std::uint32_t> places;
  Grower grower(field, claimed);
  for (int round = 0; round < options.rounds && fruitless < 2; ++round) {
    Points free = unclaimed(field.points, claimed, places);
    std::vector<Seed> seeds;
    { Timer t("  seeds"); if (first && round==0) seeds=*first; else seeds = find_seeds(free, static_cast<std::size_t>(options.seeds)); }
    std::size_t fresh = 0;
    Timer t("  grow");
    for (const Seed& seed : seeds) {
      if (claimed[places[seed.place]] != 0) continue;
      const Grown grown = grower.grow(seed, mixture.sigma());
      if (grown.members.size() < static_cast<std::size_t>(options.min_points)) continue;
      const Evidence evidence = evidence_of(field, claimed, grown, mixture.sigma(), 0.5 / volume);
      const bool ok=convincing(evidence, field.points.count, static_cast<std::size_t>(options.min_points));
      if (getenv("D")) fprintf(stderr,"seed flat %.4f noise %.4f r %.3f -> n %zu bg %.1f ratio %.2f gain %.1f %d\n",seed.flatness,seed.noise,seed.radius,evidence.members,evidence.background,evidence.noise_ratio,evidence.gain,ok);
      if (!ok) continue;
      for (const std::uint32_t i : grown.members) claimed[i] = 1;
      mixture.add(grown);
      ++fresh;
    }
    found += fresh;
    fruitless = fresh == 0 ? fruitless + 1 : 0;
  }
  return found;
}

static void settle(Mixture& mixture, const AutoOptions& options) {
  Timer t(" settle");
  for (int pass = 0; pass < options.passes; ++pass) {
    { Timer tt("  assign"); mixture.assign();}
    while (mixture.cull(static_cast<std::size_t>(options.min_points))) mixture.assign();
    { Timer tt("  refit");mixture.refit();}
    { Timer tt("  cover");mixture.cover();}
    { Timer tt("  merge");if (mixture.merge()) mixture.assign();}
  }
  mixture.assign();
  while (mixture.cull(static_cast<std::size_t>(options.min_points))) mixture.assign();
}

Extraction PlaneExtractor::extract(std::span<const Vec3> cloud) const {
  Extraction result;
  result.labels.assign(cloud.size(), kNoPlane);
  Timer t("all");
  CanonicalCloud canonical;
  { Timer tt("order"); canonical = canonical_order(cloud); }
  const Points& points = canonical.points;
  const BoxTree tree(points);
  const PointField field{points, tree};
  std::vector<Seed> seeds;
  { Timer tt("seeds0"); seeds= find_seeds(points, static_cast<std::size_t>(options_.seeds)); }
  if (seeds.empty()) return result;
  const double sigma = options_.noise > 0.0 ? options_.noise : noise_of_seeds(seeds);
  if (getenv("D")) fprintf(stderr,"sigma %.5f\n",sigma);
  const double volume = volume_of(canonical.extent, sigma);
  Mixture mixture(field, volume, sigma);
  std::vector<std::uint8_t> claimed(points.blocks() * kBlockSize, 0);
  peel(field, options_, claimed, volume, mixture, &seeds);
  settle(mixture, options_);
  for (std::size_t i = 0; i < points.count; ++i) claimed[i] = mixture.labels()[i] != kNoPlane;
  if (peel(field, options_, claimed, volume, mixture, nullptr) > 0) settle(mixture, options_);
  result.noise = mixture.sigma();
  for (const Patch& patch : mixture.patches) {
    Plane plane;
    plane.normal = patch.frame.normal;
    result.planes.push_back(plane);
  }
  for (std::size_t i = 0; i < points.count; ++i) {
    for (const PointIndex given : canonical.given_at(i)) result.labels[given] = mixture.labels()[i];
  }
  return result;
}

}  // namespace hallway::em
