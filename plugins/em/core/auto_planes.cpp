// SPDX-License-Identifier: MIT
#include "em/core/auto_planes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "em/core/canonical.hpp"
#include "em/core/evidence.hpp"
#include "em/core/growth.hpp"
#include "em/core/local_search.hpp"
#include "em/core/mixture.hpp"
#include "em/core/search.hpp"

namespace hallway::em {
namespace {
struct Timer { static double now(){timespec t;clock_gettime(CLOCK_THREAD_CPUTIME_ID,&t);return static_cast<double>(t.tv_sec)*1e3+static_cast<double>(t.tv_nsec)*1e-6;} const char* n; double t=now(); explicit Timer(const char*x):n(x){} ~Timer(){ if (getenv("T")) fprintf(stderr,"%s %.3f ms\n",n,now()-t);} };

/// Every so many-th point, so that about `wanted` are left: even in space, for the points are in Morton order.
Points sample_of(const Points& points, std::size_t wanted) {
  if (points.count <= wanted * 3 / 2) return points;
  Points sample;
  sample.resize(wanted);
  for (std::size_t k = 0; k < wanted; ++k) sample.set(k, points.at(k * points.count / wanted));
  return sample;
}

double volume_of(const Vec3& extent, double sigma) {
  return extent.cwiseMax(20.0 * sigma).prod();
}
}  // namespace

static void settle(Mixture& mixture, const AutoOptions& options) {
  Timer t(" settle");
  std::vector<std::uint32_t> before;
  for (int pass = 0; pass < options.passes; ++pass) {
    { Timer tt("  assign"); mixture.assign();}
    while (mixture.cull(static_cast<std::size_t>(options.min_points))) { before.clear(); mixture.assign();}
    std::size_t changed=0;
    const auto& labels=mixture.labels();
    if (!before.empty()) for (std::size_t i=0;i<labels.size();++i) changed += labels[i]!=before[i];
    if (!before.empty() && changed*500 < labels.size()) break;
    before=labels;
    { Timer tt("  refit");mixture.refit();}
    { Timer tt("  cover");mixture.cover();}
    { Timer tt("  merge");if (mixture.merge()) {before.clear(); mixture.assign();}}
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
  const double rough_volume = volume_of(canonical.extent, 0.0);
  const Points sample = sample_of(points, static_cast<std::size_t>(options_.sample_points));
  const bool sampled = sample.count < points.count;
  const BoxTree sample_tree(sample);
  const PointField sample_field{sample, sample_tree};
  PlaneSearch search(sample_field, options_, rough_volume);
  double sigma = options_.noise;
  if (!(sigma > 0.0)) { Timer tt("noise"); sigma = search.estimate_noise(); }
  if (!(sigma > 0.0)) return result;
  if (getenv("D")) fprintf(stderr,"sigma %.5f\n",sigma);
  const double volume = volume_of(canonical.extent, sigma);
  Mixture mixture(sample_field, volume, sigma);
  std::vector<std::uint8_t> claimed(sample.blocks() * kBlockSize, 0);
  { Timer tt("search1"); for (const Grown& grown : search.find(sigma, 1, claimed)) mixture.add(grown); }
  { Timer tt("settle1"); settle(mixture, options_);}
  for (std::size_t i = 0; i < sample.count; ++i) claimed[i] = mixture.labels()[i] != kNoPlane;
  std::vector<Grown> more;
  { Timer tt("search2"); more=search.find(mixture.sigma(), 2, claimed);}
  if (!more.empty()) {
    Timer tt("settle2");
    for (const Grown& grown : more) mixture.add(grown);
    settle(mixture, options_);
  }
  Mixture whole(field, volume, mixture.sigma());
  if (sampled) {
    Timer tt("whole");
    whole.patches = std::move(mixture.patches);
    const double factor = static_cast<double>(points.count) / static_cast<double>(sample.count);
    for (Patch& patch : whole.patches) {
      patch.density *= factor;
      for (float& value : patch.log_density) {
        if (value != kNotSupported) value += static_cast<float>(std::log(factor));
      }
    }
    whole.assign();
    whole.refit();
    whole.cover();
    whole.assign();
  } else { std::swap(whole, mixture); }
  result.noise = whole.sigma();
  for (const Patch& patch : whole.patches) {
    Plane plane;
    plane.normal = patch.frame.normal;
    result.planes.push_back(plane);
  }
  for (std::size_t i = 0; i < points.count; ++i) {
    for (const PointIndex given : canonical.given_at(i)) result.labels[given] = whole.labels()[i];
  }
  return result;
}

}  // namespace hallway::em
