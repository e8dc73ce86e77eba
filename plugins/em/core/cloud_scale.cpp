// SPDX-License-Identifier: MIT
#include "em/core/cloud_scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "em/core/plane_fit.hpp"
#include "geometry/median.hpp"

namespace hallway::em {
namespace {

constexpr std::size_t kSamples = 200;
constexpr std::size_t kSpacingNeighbours = 8;
constexpr std::array<std::size_t, 4> kSizes{12, 24, 48, 96};

struct Flatness {
  double ratio = 0.0;  ///< least by middle variance
  double noise = 0.0;
};

std::optional<Flatness> flattest(std::span<const Vec3> points, const std::vector<Neighbour>& neighbours) {
  std::optional<Flatness> best;
  Moments moments;
  std::size_t used = 0;
  for (const std::size_t size : kSizes) {
    if (size > neighbours.size()) break;
    for (; used < size; ++used) moments.add(points[neighbours[used].index] - points[neighbours[0].index]);
    const auto fit = fit_plane(moments);
    if (!fit) continue;
    const double n = static_cast<double>(size);
    const double across = std::max(fit->variances[0], 0.0);
    const double ratio = across / fit->variances[1];
    if (best && best->ratio <= ratio) continue;
    best = Flatness{ratio, std::sqrt(across * n / (n - 3.0))};  // three parameters are fitted
  }
  return best;
}

double noise_of(std::vector<Flatness> neighbourhoods) {
  std::sort(neighbourhoods.begin(), neighbourhoods.end(), [](const Flatness& a, const Flatness& b) {
    return a.ratio != b.ratio ? a.ratio < b.ratio : a.noise < b.noise;
  });
  std::vector<double> noises;
  for (std::size_t i = 0; 4 * i < neighbourhoods.size(); ++i) noises.push_back(neighbourhoods[i].noise);
  return noises.empty() ? 0.0 : median(noises);
}

}  // namespace

CloudScale measure_scale(std::span<const Vec3> points, const KdTree& tree) {
  if (points.size() < kSizes.front()) return {};
  std::vector<double> spacings;
  std::vector<Flatness> neighbourhoods;
  std::vector<Neighbour> neighbours;
  const std::size_t samples = std::min(kSamples, points.size());
  for (std::size_t i = 0; i < samples; ++i) {
    const Vec3& p = points[i * points.size() / samples];
    tree.nearest(p, kSizes.back(), neighbours);
    // k points other than p within r: one point per area pi r^2 / k.
    const double k = static_cast<double>(kSpacingNeighbours);
    spacings.push_back(std::sqrt(M_PI * neighbours[kSpacingNeighbours].distance2 / k));
    if (const auto flat = flattest(points, neighbours)) neighbourhoods.push_back(*flat);
  }
  return {median(spacings), noise_of(std::move(neighbourhoods))};
}

}  // namespace hallway::em
