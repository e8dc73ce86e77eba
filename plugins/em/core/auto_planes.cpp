// SPDX-License-Identifier: MIT
#include "em/core/auto_planes.hpp"

#include <algorithm>

#include "em/core/canonical.hpp"
#include "em/core/extraction.hpp"
#include "em/core/gaps.hpp"
#include "em/core/mixture.hpp"
#include "em/core/search.hpp"

namespace hallway::em {
namespace {

constexpr double kThinnest =
    20.0;  // noises: a cloud of one plane has a volume too, in which outliers may lie
constexpr std::size_t kFewLeft = 50;  // one point in so many in no plane: no rougher surface is looked for
constexpr std::size_t kManyLeft = 5;  // one in so many: more than outliers
constexpr double kWarmRadius =
    0.25;  // of the shorter side: where a plane of the last frame starts to grow again
constexpr std::size_t kSettled = 500;  // one changed label in so many is no change

/// Every so many-th point: even in space too, since the points are in Morton order.
Points sample_of(const Points& points, std::size_t wanted, Workers& workers) {
  if (points.count <= wanted + wanted / 2) return points;
  Points sample;
  sample.resize(wanted);
  workers.run_parts(wanted, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) sample.set(k, points.at(k * points.count / wanted));
  });
  return sample;
}

void assign_and_cull(Mixture& mixture, std::size_t min_points) {
  mixture.assign();
  while (mixture.cull(min_points)) mixture.assign();
}

bool about_equal(const std::vector<std::uint32_t>& left, const std::vector<std::uint32_t>& right) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < left.size(); ++i) different += left[i] != right[i] ? 1u : 0u;
  return different * kSettled < left.size();
}

/// Expectation and maximisation in turns until hardly a label changes.
void settle(Mixture& mixture, const AutoOptions& options) {
  const auto min_points = static_cast<std::size_t>(options.min_points);
  std::vector<std::uint32_t> before;
  for (int pass = 0; pass < options.passes; ++pass) {
    const std::size_t patches = mixture.patches.size();
    assign_and_cull(mixture, min_points);
    const bool same = !before.empty() && mixture.patches.size() == patches;
    if (same && about_equal(before, mixture.labels())) return;
    before = mixture.labels();
    mixture.refit();
    mixture.cover();
    if (mixture.merge()) before.clear();
  }
  assign_and_cull(mixture, min_points);
}

/// Searches among the points of no patch with noise `sigma`; true if that gave more patches.
bool add_planes(PlaneSearch& search, double sigma, int fruitless, Mixture& mixture) {
  std::vector<std::uint8_t> claimed(mixture.labels().size());
  std::transform(mixture.labels().begin(), mixture.labels().end(), claimed.begin(),
                 [](std::uint32_t label) { return static_cast<std::uint8_t>(label != kNoPlane); });
  const std::vector<Grown> found = search.find(sigma, fruitless, claimed);
  for (const Grown& grown : found) mixture.patches.push_back(patch_of(grown));
  return !found.empty();
}

/// All planes that show among the points of `search`: those with the cloud's noise, what these left over,
/// then rougher and rougher ones.
void find_planes(PlaneSearch& search, const AutoOptions& options, double sigma, Mixture& mixture) {
  add_planes(search, sigma, 1, mixture);
  settle(mixture, options);
  double level = mixture.patches.empty() ? sigma : mixture.noise();
  if (add_planes(search, level, 2, mixture)) settle(mixture, options);
  const std::size_t n = mixture.labels().size();
  for (int k = 0; k < options.rougher && mixture.unassigned() * kFewLeft > n; ++k) {
    const double rougher = search.rougher_noise(level, mixture.labels());
    if (!(rougher > 0.0) && k == 0 && mixture.unassigned() * kManyLeft < n) return;
    // With the same level again: what planes gave up when they were settled may make others.
    if (rougher > 0.0) level = rougher;
    search.take_facets();
    if (!add_planes(search, level, 2, mixture)) return;
    settle(mixture, options);
  }
}

/// The same planes with all points of the cloud, of which `sampled` had but some.
void settle_with_all(Mixture& sampled, double factor, const AutoOptions& options, Mixture& whole) {
  const auto min_points = static_cast<std::size_t>(options.min_points);
  for (const Patch& patch : sampled.patches) whole.patches.push_back(denser(patch, factor));
  assign_and_cull(whole, min_points);
  if (whole.split(min_points)) whole.assign();
  whole.refit();
  whole.cover(min_points);
  assign_and_cull(whole, min_points);
}

/// Where the planes of the last frame would go on in one of `points` points in the frame `frame`: about their middles.
std::vector<Seed> seeds_from(const PlaneMemory& memory, const CloudFrame& frame, std::size_t points) {
  std::vector<Seed> seeds;
  for (std::size_t j = 0; j < memory.planes().size(); ++j) {
    const Plane& plane = memory.planes()[j];
    const double side = (plane.corners[1] - plane.corners[0]).norm();
    const double other = (plane.corners[2] - plane.corners[1]).norm();
    const double share = static_cast<double>(memory.members()[j]) / static_cast<double>(memory.points());
    Seed seed;
    seed.frame = frame_on(frame.from_cloud(plane.centroid), frame.axes.transpose() * plane.normal);
    seed.radius = kWarmRadius * std::min(side, other);
    seed.density = share * static_cast<double>(points) / (side * other);
    seed.noise = plane.rms;
    if (seed.radius > 0.0) seeds.push_back(seed);
  }
  return seeds;
}

Extraction with_gaps(std::span<const Vec3> cloud, const AutoOptions& options, Extraction found) {
  if (options.gap > 0.0)
    split_at_gaps(cloud, options.gap, static_cast<std::size_t>(options.min_points), found);
  return found;
}

}  // namespace

PlaneExtractor::PlaneExtractor(const AutoOptions& options) : options_(options) {
  options_.validate();
  workers_ = std::make_unique<Workers>(options_.threads);
}

Extraction PlaneExtractor::extract(std::span<const Vec3> cloud) const {
  return extract_from(cloud, PlaneMemory());
}

Extraction PlaneExtractor::extract(std::span<const Vec3> cloud, PlaneMemory& memory) const {
  Extraction found = extract_from(cloud, memory);
  memory.identify(found);
  return found;
}

Extraction PlaneExtractor::extract_from(std::span<const Vec3> cloud, const PlaneMemory& memory) const {
  const CanonicalCloud canonical = canonical_order(cloud, *workers_);
  const Points sample =
      sample_of(canonical.points, static_cast<std::size_t>(options_.sample_points), *workers_);
  const BoxTree sample_tree(sample, *workers_);
  const PointField sample_field{sample, sample_tree};

  PlaneSearch search(sample_field, options_, canonical.frame.extent, *workers_);
  const double sigma = options_.noise > 0.0 ? options_.noise : search.estimate_noise();
  const double volume = canonical.frame.extent.cwiseMax(kThinnest * sigma).prod();
  Mixture mixture(sample_field, volume, *workers_);
  if (sigma > 0.0) {
    search.begin_with(seeds_from(memory, canonical.frame, sample.count));
    find_planes(search, options_, sigma, mixture);
  }
  if (sample.count == canonical.points.count) {
    return with_gaps(cloud, options_, extraction_of(canonical, mixture, options_, cloud.size(), *workers_));
  }

  const BoxTree tree(canonical.points, *workers_);
  const PointField field{canonical.points, tree};
  Mixture whole(field, volume, *workers_);
  const double factor = static_cast<double>(canonical.points.count) / static_cast<double>(sample.count);
  settle_with_all(mixture, factor, options_, whole);
  return with_gaps(cloud, options_, extraction_of(canonical, whole, options_, cloud.size(), *workers_));
}

}  // namespace hallway::em
