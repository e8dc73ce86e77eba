// SPDX-License-Identifier: MIT
#include "sense/face_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

namespace hallway::sense {
namespace {

constexpr double kCoplanar = 1e-10;     ///< 1 - cos of the largest angle between polygons of one face
constexpr double kSameArea = 1e-9;      ///< relative; a hull is no larger than its parts
constexpr double kFlatOfFace_m = 1e-6;  ///< a corner that stands out less is none
constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();

/// Polygons of one plane that touch, each laid flat.
struct Group {
  Plane plane;
  std::vector<Convex> parts;
};

/// A polygon's corners in its plane.
Convex flattened(const csg::Surface& surface, const csg::SurfacePolygon& polygon, const PlaneAxes& axes) {
  Convex flat;
  for (const std::uint32_t vertex : polygon.vertices) flat.push_back(axes.flat(surface.vertices[vertex]));
  return flat;
}

/// Finds which polygons of one plane touch along an edge. The surface has no T-junctions.
class Groups {
 public:
  Groups(const csg::Surface& surface, const std::function<bool(std::size_t)>& wanted) : surface_(surface) {
    const std::size_t n = surface.polygons.size();
    first_.assign(n, kNowhere);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> at_edge;
    for (std::size_t i = 0; i < n; ++i) {
      const std::vector<std::uint32_t>& vertices = surface.polygons[i].vertices;
      if (vertices.empty() || (wanted && !wanted(i))) continue;
      first_[i] = i;
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        const std::uint32_t a = vertices[k], b = vertices[(k + 1) % vertices.size()];
        std::vector<std::size_t>& here = at_edge[{std::min(a, b), std::max(a, b)}];
        for (const std::size_t other : here) {
          if (same_plane(i, other)) join(i, other);
        }
        here.push_back(i);
      }
    }
  }

  /// In the order of their first polygons.
  std::vector<Group> all() {
    std::map<std::size_t, Group> groups;
    for (std::size_t i = 0; i < first_.size(); ++i) {
      if (first_[i] == kNowhere) continue;
      const std::size_t root = root_of(i);
      Group& group = groups[root];
      group.plane = surface_.polygons[root].plane;
      group.parts.push_back(flattened(surface_, surface_.polygons[i], PlaneAxes(group.plane.normal)));
    }
    std::vector<Group> list;
    for (auto& [root, group] : groups) list.push_back(std::move(group));
    return list;
  }

 private:
  bool same_plane(std::size_t a, std::size_t b) const {
    return surface_.polygons[a].plane.normal.dot(surface_.polygons[b].plane.normal) > 1.0 - kCoplanar;
  }
  std::size_t root_of(std::size_t i) {
    while (first_[i] != i) i = first_[i] = first_[first_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = root_of(a);
    b = root_of(b);
    first_[std::max(a, b)] = std::min(a, b);
  }

  const csg::Surface& surface_;
  std::vector<std::size_t> first_;
};

/// The hull of parts if it is no larger than they are together, else nothing.
Convex joined(const std::vector<const Convex*>& parts) {
  double sum = 0.0;
  std::vector<Vec2> points;
  for (const Convex* part : parts) {
    sum += polygon_area(*part);
    points.insert(points.end(), part->begin(), part->end());
  }
  Convex hull = hull_of(std::move(points), kFlatOfFace_m);
  return polygon_area(hull) <= sum * (1.0 + kSameArea) ? hull : Convex{};
}

/// Joins parts as long as two of them are convex together.
void join_pairs(std::vector<Convex>& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t k = i + 1; k < parts.size();) {
      Convex both = joined({&parts[i], &parts[k]});
      if (both.empty()) {
        ++k;
        continue;
      }
      parts[i] = std::move(both);
      parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(k));
      k = i + 1;
    }
  }
}

}  // namespace

FacePlan make_face_plan(const csg::Surface& surface, const std::function<bool(std::size_t)>& wanted) {
  FacePlan plan;
  for (const csg::SurfacePolygon& polygon : surface.polygons) {
    if (polygon.vertices.empty()) continue;
    Polygon& obstacle = plan.obstacles.emplace_back();
    obstacle.plane = polygon.plane;
    for (const std::uint32_t vertex : polygon.vertices) obstacle.vertices.push_back(surface.vertices[vertex]);
  }
  for (Group& group : Groups(surface, wanted).all()) {
    const PlaneAxes axes(group.plane.normal);
    std::vector<const Convex*> parts;
    for (const Convex& part : group.parts) parts.push_back(&part);
    std::vector<Convex> faces;
    if (Convex whole = joined(parts); !whole.empty()) {
      faces.push_back(std::move(whole));
    } else {
      faces = std::move(group.parts);
      join_pairs(faces);
      for (Convex& face : faces) face = hull_of(std::move(face), kFlatOfFace_m);
    }
    for (const Convex& face : faces) {
      if (face.size() < 3) continue;
      Polygon& polygon = plan.faces.emplace_back();
      polygon.plane = group.plane;
      for (const Vec2& p : face) polygon.vertices.push_back(axes.lift(p, group.plane.offset));
    }
  }
  return plan;
}

}  // namespace hallway::sense
