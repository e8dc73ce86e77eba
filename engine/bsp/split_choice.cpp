// SPDX-License-Identifier: MIT
#include "bsp/split_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geom/box.hpp"

namespace hallway::bsp {
namespace {

/// A plane that may be chosen, with the area of the facets in it.
struct Candidate {
  std::uint32_t plane = 0;
  double area = 0.0;
  std::size_t facets = 0;
};

bool is_axial(const ExactPlane& plane) {
  return plane.unit.normal.cwiseAbs().maxCoeff() == 1.0;
}

std::vector<Candidate> gather(std::span<const FacetShape> facets) {
  std::vector<Candidate> all;
  for (const FacetShape& facet : facets) {
    if (facet.candidate) all.push_back({facet.plane, facet.area, 1});
  }
  std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.plane < b.plane; });
  std::vector<Candidate> merged;
  for (const Candidate& candidate : all) {
    if (merged.empty() || merged.back().plane != candidate.plane) {
      merged.push_back(candidate);
    } else {
      merged.back().area += candidate.area;
      ++merged.back().facets;
    }
  }
  return merged;
}

/// Keeps half of what may stay for the planes with the largest faces, which cut least for what they decide, and half for planes picked evenly from the rest,
/// which lie everywhere.
void keep_some(std::vector<Candidate>& candidates, std::size_t most) {
  if (candidates.size() <= most) return;
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::pair(-a.area, a.plane) < std::pair(-b.area, b.plane);
  });
  const std::size_t largest = (most + 1) / 2;
  const std::size_t others = most - largest;
  const std::size_t rest = candidates.size() - largest;
  for (std::size_t i = 0; i < others; ++i) candidates[largest + i] = candidates[largest + i * rest / others];
  candidates.resize(most);
}

double cost_of(const PlaneSet& planes, const Candidate& candidate, std::span<const FacetShape> facets,
               const BuildOptions& options) {
  constexpr double kTouch = 1e-3;  // a facet that reaches across by less is taken to touch
  const Plane& plane = planes[candidate.plane].unit;
  const Vec3 spread = plane.normal.cwiseAbs();
  double front = 0.0, back = 0.0, cut = 0.0, on = 0.0;
  for (const FacetShape& facet : facets) {
    if (facet.plane == candidate.plane) {
      on += 1.0;
      continue;
    }
    const double distance = plane.distance(facet.middle);
    const double reach = spread.dot(facet.half) - kTouch;
    if (distance >= reach) {
      front += 1.0;
    } else if (distance <= -reach) {
      back += 1.0;
    } else {
      cut += 1.0;
    }
  }
  double cost =
      options.split_cost * cut + options.balance_cost * std::abs(front - back) - options.on_gain * on;
  if (!is_axial(planes[candidate.plane])) cost += options.oblique_cost * static_cast<double>(facets.size());
  return cost;
}

}  // namespace

FacetShape shape_of(const Facet& facet) {
  Box box;
  for (const FacetEdge& edge : facet.edges) box.extend(edge.start.at);
  return {facet.plane, false, box.center(), 0.5 * box.sizes(), 0.5 * area_vector(facet).norm()};
}

std::uint32_t choose_plane(const PlaneSet& planes, std::span<const FacetShape> facets,
                           const BuildOptions& options) {
  if (options.rule == SplitRule::kNaive) {
    return std::find_if(facets.begin(), facets.end(), [](const FacetShape& f) { return f.candidate; })->plane;
  }
  std::vector<Candidate> candidates = gather(facets);
  if (options.rule == SplitRule::kAxialFirst) {
    std::vector<Candidate> axial;
    for (const Candidate& candidate : candidates) {
      if (is_axial(planes[candidate.plane])) axial.push_back(candidate);
    }
    if (!axial.empty()) candidates = std::move(axial);
  }
  keep_some(candidates, std::max<std::size_t>(options.candidates, 1));
  std::uint32_t best = candidates.front().plane;
  double best_cost = std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : candidates) {
    const double cost = cost_of(planes, candidate, facets, options);
    if (cost < best_cost || (cost == best_cost && candidate.plane < best)) {
      best = candidate.plane;
      best_cost = cost;
    }
  }
  return best;
}

}  // namespace hallway::bsp
