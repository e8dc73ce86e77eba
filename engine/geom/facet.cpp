// SPDX-License-Identifier: MIT
#include "geom/facet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace hallway {
namespace {

using Side = PlaneSet::Side;

constexpr std::size_t kFewSides = 64;

/// The side of each corner; on the stack for all but monstrous facets.
class Sides {
 public:
  Sides(const PlaneSet& planes, const Facet& facet, std::uint32_t plane) {
    const std::size_t count = facet.edges.size();
    if (count > kFewSides) many_.resize(count);
    Side* sides = data();
    for (std::size_t i = 0; i < count; ++i) {
      sides[i] = planes.side(plane, facet.edges[i].start);
      front_ = front_ || sides[i] == Side::kFront;
      back_ = back_ || sides[i] == Side::kBack;
    }
  }
  Side operator[](std::size_t i) const { return many_.empty() ? few_[i] : many_[i]; }
  FacetSide all() const {
    if (front_ && back_) return FacetSide::kSplit;
    if (front_) return FacetSide::kFront;
    return back_ ? FacetSide::kBack : FacetSide::kOn;
  }

 private:
  Side* data() { return many_.empty() ? few_.data() : many_.data(); }

  std::array<Side, kFewSides> few_;
  std::vector<Side> many_;
  bool front_ = false;
  bool back_ = false;
};

/// What lies on the side `keep` of a facet that the plane splits.
Facet part(const PlaneSet& planes, const Facet& facet, std::uint32_t plane, const Sides& sides, Side keep) {
  Facet out;
  out.plane = facet.plane;
  const std::size_t count = facet.edges.size();
  out.edges.reserve(count + 1);
  for (std::size_t i = 0; i < count; ++i) {
    const FacetEdge& edge = facet.edges[i];
    const Side from = sides[i];
    const Side to = sides[(i + 1) % count];
    const bool starts = from == keep;
    const bool ends = to == keep;
    if (starts) out.edges.push_back(edge);
    if (!starts && ends) {  // enters
      if (from == Side::kOn) {
        out.edges.push_back(edge);
      } else {
        out.edges.push_back({planes.intersect(facet.plane, plane, edge.plane), edge.plane});
      }
    } else if (starts && !ends && to != Side::kOn) {  // leaves across the plane
      out.edges.push_back({planes.intersect(facet.plane, edge.plane, plane), plane});
    } else if (!starts && from == Side::kOn &&
               sides[(i + count - 1) % count] == keep) {  // leaves at a corner
      out.edges.push_back({edge.start, plane});
    }
  }
  return out;
}

}  // namespace

Facet cover_plane(PlaneSet& planes, std::uint32_t plane, double reach) {
  const Vec3 normal = planes[plane].unit.normal;
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const int u = static_cast<int>((axis + 1) % 3);
  const int v = static_cast<int>((axis + 2) % 3);
  const std::array<std::uint32_t, 4> rim{planes.add_axial(v, -reach).index, planes.add_axial(u, reach).index,
                                         planes.add_axial(v, reach).index, planes.add_axial(u, -reach).index};
  Facet facet;
  facet.plane = plane;
  const bool up = normal[axis] > 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t own = up ? i : 3 - i;
    const std::size_t before = up ? (i + 3) % 4 : (own + 1) % 4;
    facet.edges.push_back({planes.intersect(plane, rim[before], rim[own]), rim[own]});
  }
  return facet;
}

FacetSide classify(const PlaneSet& planes, const Facet& facet, std::uint32_t plane) {
  if (facet.plane == plane) return FacetSide::kOn;
  return Sides(planes, facet, plane).all();
}

FacetSide split(const PlaneSet& planes, Facet& facet, std::uint32_t plane, Facet& front, Facet& back) {
  if (facet.plane == plane) return FacetSide::kOn;
  const Sides sides(planes, facet, plane);
  const FacetSide answer = sides.all();
  if (answer == FacetSide::kFront) {
    front = std::move(facet);
  } else if (answer == FacetSide::kBack) {
    back = std::move(facet);
  } else if (answer == FacetSide::kSplit) {
    front = part(planes, facet, plane, sides, Side::kFront);
    back = part(planes, facet, plane, sides, Side::kBack);
  }
  return answer;
}

void clip(const PlaneSet& planes, Facet& facet, std::uint32_t plane, bool keep_front) {
  if (facet.plane == plane) {
    facet.edges.clear();
    return;
  }
  const Sides sides(planes, facet, plane);
  const FacetSide answer = sides.all();
  if (answer == FacetSide::kSplit) {
    facet = part(planes, facet, plane, sides, keep_front ? Side::kFront : Side::kBack);
  } else if (answer != (keep_front ? FacetSide::kFront : FacetSide::kBack)) {
    facet.edges.clear();
  }
}

Vec3 area_vector(const Facet& facet) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < facet.edges.size(); ++i) {
    sum += (facet.edges[i - 1].start.at - facet.edges[0].start.at)
               .cross(facet.edges[i].start.at - facet.edges[0].start.at);
  }
  return sum;
}

double width(const PlaneSet& planes, const Facet& facet) {
  const Vec3 normal = planes[facet.plane].unit.normal;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < facet.edges.size(); ++i) {
    const Vec3& from = facet.edges[i].start.at;
    const Vec3 along = facet.edges[(i + 1) % facet.edges.size()].start.at - from;
    if (along.norm() < 1e-9) continue;
    const Vec3 inward = normal.cross(along).normalized();
    double farthest = 0.0;
    for (const FacetEdge& edge : facet.edges) farthest = std::max(farthest, inward.dot(edge.start.at - from));
    least = std::min(least, farthest);
  }
  return std::isfinite(least) ? least : 0.0;
}

}  // namespace hallway
