// SPDX-License-Identifier: MIT
#include "csg/merge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace hallway::csg {
namespace {

using Side = PlaneSet::Side;

/// An edge of a facet under a key that its two directions share; equal points have equal or neighbouring keys only up to rounding, so a pair may be
/// missed where a key is rounded apart: then the facets stay two, which is no error.
struct EdgeKey {
  std::array<std::int64_t, 6> ends{};
  std::size_t facet = 0;
  std::size_t edge = 0;
};

std::array<std::int64_t, 3> rounded(const Vec3& point) {
  constexpr double kSteps = 1024.0;
  return {std::llround(point.x() * kSteps), std::llround(point.y() * kSteps),
          std::llround(point.z() * kSteps)};
}

EdgeKey key_of(const Facet& facet, std::size_t index, std::size_t edge) {
  auto a = rounded(facet.edges[edge].start.at);
  auto b = rounded(facet.edges[(edge + 1) % facet.edges.size()].start.at);
  if (b < a) std::swap(a, b);
  return {{a[0], a[1], a[2], b[0], b[1], b[2]}, index, edge};
}

/// On which side of an edge's plane the facet lies.
Side inner_side(const PlaneSet& planes, const Facet& facet, std::uint32_t edge_plane) {
  for (const FacetEdge& edge : facet.edges) {
    const Side side = planes.side(edge_plane, edge.start);
    if (side != Side::kOn) return side;
  }
  return Side::kOn;
}

enum class Turn { kConvex, kStraight, kReflex };

/// How the boundary turns where it leaves `facet` along edge `last` and goes on to `next`.
Turn turn(const PlaneSet& planes, const Facet& facet, std::size_t last, const ExactPoint& next) {
  const std::uint32_t plane = facet.edges[last].plane;
  const Side side = planes.side(plane, next);
  if (side == Side::kOn) return Turn::kStraight;
  return side == inner_side(planes, facet, plane) ? Turn::kConvex : Turn::kReflex;
}

/// The union of two facets that share the edges `ea` of `a` and `eb` of `b`; empty if it is not convex.
std::optional<Facet> joined(const PlaneSet& planes, const Facet& a, std::size_t ea, const Facet& b,
                            std::size_t eb) {
  const std::size_t na = a.edges.size();
  const std::size_t nb = b.edges.size();
  const auto at = [](const Facet& facet, std::size_t i) -> const FacetEdge& {
    return facet.edges[i % facet.edges.size()];
  };
  if (!planes.same(at(a, ea).start, at(b, eb + 1).start) ||
      !planes.same(at(a, ea + 1).start, at(b, eb).start))
    return std::nullopt;
  const Turn from_a = turn(planes, a, (ea + na - 1) % na, at(b, eb + 2).start);
  const Turn from_b = turn(planes, b, (eb + nb - 1) % nb, at(a, ea + 2).start);
  if (from_a == Turn::kReflex || from_b == Turn::kReflex) return std::nullopt;
  Facet out;
  out.plane = a.plane;
  // Where the boundary goes straight on, two edges become one.
  for (std::size_t k = from_b == Turn::kStraight ? 2 : 1; k < na; ++k) out.edges.push_back(at(a, ea + k));
  for (std::size_t k = from_a == Turn::kStraight ? 2 : 1; k < nb; ++k) out.edges.push_back(at(b, eb + k));
  if (out.edges.size() < 3) return std::nullopt;
  return out;
}

/// One round: joins disjoint pairs. False if there was nothing to join.
bool merge_round(const PlaneSet& planes, std::vector<Facet>& facets) {
  std::vector<EdgeKey> keys;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (std::size_t e = 0; e < facets[f].edges.size(); ++e) keys.push_back(key_of(facets[f], f, e));
  }
  std::sort(keys.begin(), keys.end(), [](const EdgeKey& a, const EdgeKey& b) {
    return std::tie(a.ends, a.facet, a.edge) < std::tie(b.ends, b.facet, b.edge);
  });
  std::vector<bool> touched(facets.size(), false);
  bool any = false;
  for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
    const EdgeKey& a = keys[k];
    const EdgeKey& b = keys[k + 1];
    if (a.ends != b.ends || a.facet == b.facet || touched[a.facet] || touched[b.facet]) continue;
    auto facet = joined(planes, facets[a.facet], a.edge, facets[b.facet], b.edge);
    if (!facet) continue;
    facets[a.facet] = std::move(*facet);
    facets[b.facet].edges.clear();
    touched[a.facet] = touched[b.facet] = true;
    any = true;
  }
  std::erase_if(facets, [](const Facet& facet) { return facet.empty(); });
  return any;
}

}  // namespace

void merge_convex(const PlaneSet& planes, std::vector<Facet>& facets) {
  while (facets.size() > 1 && merge_round(planes, facets)) {
  }
}

}  // namespace hallway::csg
