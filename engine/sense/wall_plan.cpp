// SPDX-License-Identifier: MIT
#include "sense/wall_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace hallway::sense {
namespace {

constexpr double kVertical = 1e-6;    ///< largest z of the normal of a vertical face
constexpr double kSamePlane = 1e-10;  ///< 1 - cos of the largest angle between faces of one wall
constexpr double kLeastOverlap =
    1e-6;  ///< metres of wall that two faces must share to stand above each other
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// An edge of the surface: the numbers of its vertices, the lower one first. The surface has no T-junctions, so that the two polygons
/// at an edge have the same one, and cut it at the same point bit by bit.
using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge_of(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

Vec2 level(const Vec3& point) {
  return point.head<2>();
}

/// Where the segment between two points on different sides of a height crosses it.
Vec2 crossing(const Vec3& a, const Vec3& b, double height_m) {
  return level(a) + (height_m - a.z()) / (b.z() - a.z()) * (level(b) - level(a));
}

/// What a height cuts from a polygon. A vertex at the height counts as above.
struct Cut {
  std::size_t polygon = 0;
  Edge left_edge, right_edge;  ///< as they are seen from the empty side
  Vec2 left, right;
};

std::optional<Cut> cut_polygon(const csg::Surface& surface, std::size_t index, double height_m) {
  const std::vector<std::uint32_t>& vertices = surface.polygons[index].vertices;
  Cut cut{.polygon = index, .left_edge = {}, .right_edge = {}, .left = {}, .right = {}};
  bool found = false;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const std::uint32_t a = vertices[i], b = vertices[(i + 1) % vertices.size()];
    const bool a_below = surface.vertices[a].z() < height_m;
    if (a_below == (surface.vertices[b].z() < height_m)) continue;
    const Edge edge = edge_of(a, b);
    const Vec2 at = crossing(surface.vertices[edge.first], surface.vertices[edge.second], height_m);
    // Counter-clockwise as seen from the empty side, the way leads up on the right.
    (a_below ? cut.right_edge : cut.left_edge) = edge;
    (a_below ? cut.right : cut.left) = at;
    found = true;
  }
  if (!found) return std::nullopt;
  return cut;
}

bool same_plane(const csg::SurfacePolygon& a, const csg::SurfacePolygon& b) {
  return a.plane.normal.dot(b.plane.normal) > 1.0 - kSamePlane;  // they share an edge: their offsets agree
}

/// The vertical polygons that may be walls, and which of them share which edges.
class WallFaces {
 public:
  WallFaces(const csg::Surface& surface, const std::function<bool(std::size_t)>& wanted)
      : surface_(surface), is_face_(surface.polygons.size()) {
    for (std::size_t i = 0; i < surface.polygons.size(); ++i) {
      const csg::SurfacePolygon& polygon = surface.polygons[i];
      is_face_[i] = std::abs(polygon.plane.normal.z()) < kVertical && (!wanted || wanted(i));
      if (!is_face_[i]) continue;
      const std::size_t n = polygon.vertices.size();
      for (std::size_t k = 0; k < n; ++k)
        at_edge_[edge_of(polygon.vertices[k], polygon.vertices[(k + 1) % n])].push_back(i);
    }
  }

  bool is_face(std::size_t polygon) const { return is_face_[polygon]; }

  /// Adds what a polygon's neighbours on its plane are, one for each edge that it shares with them.
  void add_neighbours(std::size_t polygon, std::vector<std::pair<std::size_t, Edge>>& neighbours) const {
    const csg::SurfacePolygon& own = surface_.polygons[polygon];
    for (std::size_t k = 0; k < own.vertices.size(); ++k) {
      const Edge edge = edge_of(own.vertices[k], own.vertices[(k + 1) % own.vertices.size()]);
      for (const std::size_t other : at_edge_.at(edge)) {
        if (other != polygon && same_plane(own, surface_.polygons[other]))
          neighbours.emplace_back(other, edge);
      }
    }
  }

 private:
  const csg::Surface& surface_;
  std::vector<bool> is_face_;
  std::map<Edge, std::vector<std::size_t>> at_edge_;
};

/// Finds between which heights a wall stands.
class WallHeight {
 public:
  WallHeight(const csg::Surface& surface, const WallFaces& faces) : surface_(surface), faces_(faces) {}

  /// @param polygons  that the wall is made of at its height
  void find(std::vector<std::size_t> polygons, Wall& wall) const {
    std::set<std::size_t> reached(polygons.begin(), polygons.end());
    std::vector<std::pair<std::size_t, Edge>> neighbours;
    while (!polygons.empty()) {
      const std::size_t polygon = polygons.back();
      polygons.pop_back();
      extend(polygon, wall);
      neighbours.clear();
      faces_.add_neighbours(polygon, neighbours);
      for (const auto& [other, edge] : neighbours) {
        if (is_between(edge, wall) && reached.insert(other).second) polygons.push_back(other);
      }
    }
  }

 private:
  /// How far along the wall a vertex is, metres from its left end.
  double along(std::uint32_t vertex, const Wall& wall) const {
    return (level(surface_.vertices[vertex]) - wall.left).dot((wall.right - wall.left).normalized());
  }

  bool is_between(const Edge& edge, const Wall& wall) const {
    const double a = along(edge.first, wall), b = along(edge.second, wall);
    return std::min(std::max(a, b), wall.length_m()) - std::max(std::min(a, b), 0.0) > kLeastOverlap;
  }

  /// Takes in what of a polygon stands between the wall's ends.
  void extend(std::size_t polygon, Wall& wall) const {
    const std::vector<std::uint32_t>& vertices = surface_.polygons[polygon].vertices;
    const double length_m = wall.length_m();
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const std::uint32_t a = vertices[k], b = vertices[(k + 1) % vertices.size()];
      const double u = along(a, wall), v = along(b, wall);
      const double z = surface_.vertices[a].z(), dz = surface_.vertices[b].z() - z;
      if (u > -kLeastOverlap && u < length_m + kLeastOverlap) take(z, wall);
      for (const double end : {0.0, length_m}) {
        if ((u < end) != (v < end)) take(z + dz * (end - u) / (v - u), wall);
      }
    }
  }

  static void take(double height_m, Wall& wall) {
    wall.low_m = std::min(wall.low_m, height_m);
    wall.high_m = std::max(wall.high_m, height_m);
  }

  const csg::Surface& surface_;
  const WallFaces& faces_;
};

/// For each cut the one that goes on with its wall to the right, or kNone.
std::vector<std::size_t> find_next(const csg::Surface& surface, const std::vector<Cut>& cuts) {
  std::map<Edge, std::vector<std::size_t>> by_left_edge;
  for (std::size_t i = 0; i < cuts.size(); ++i) by_left_edge[cuts[i].left_edge].push_back(i);
  std::vector<std::size_t> next(cuts.size(), kNone);
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const auto found = by_left_edge.find(cuts[i].right_edge);
    if (found == by_left_edge.end()) continue;
    for (const std::size_t other : found->second) {
      if (same_plane(surface.polygons[cuts[i].polygon], surface.polygons[cuts[other].polygon]))
        next[i] = other;
    }
  }
  return next;
}

std::vector<Wall> join(const csg::Surface& surface, const WallFaces& faces, const std::vector<Cut>& cuts,
                       double height_m) {
  const std::vector<std::size_t> next = find_next(surface, cuts);
  std::vector<bool> is_first(cuts.size(), true);
  for (const std::size_t follower : next) {
    if (follower != kNone) is_first[follower] = false;
  }
  const WallHeight height(surface, faces);
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    if (!is_first[i]) continue;
    Wall wall{.left = cuts[i].left, .right = {}, .low_m = height_m, .high_m = height_m};
    std::vector<std::size_t> polygons;
    for (std::size_t at = i; at != kNone; at = next[at]) {
      wall.right = cuts[at].right;
      polygons.push_back(cuts[at].polygon);
    }
    if (wall.left == wall.right) continue;
    height.find(std::move(polygons), wall);
    walls.push_back(wall);
  }
  return walls;
}

void add_obstacles(const trace::TriangleMesh& mesh, double height_m, std::vector<Obstacle>& obstacles) {
  for (const std::array<std::uint32_t, 3>& triangle : mesh.triangles) {
    std::array<Vec2, 2> ends;
    std::size_t found = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& a = mesh.vertices[triangle[k]];
      const Vec3& b = mesh.vertices[triangle[(k + 1) % 3]];
      if ((a.z() < height_m) != (b.z() < height_m)) ends[found++] = crossing(a, b, height_m);
    }
    if (found == 2) obstacles.push_back({ends[0], ends[1]});
  }
}

}  // namespace

WallPlan make_wall_plan(const csg::Surface& surface, const std::function<bool(std::size_t)>& wanted,
                        double height_m, std::span<const trace::TriangleMesh> meshes) {
  const WallFaces faces(surface, wanted);
  WallPlan plan;
  plan.height_m = height_m;
  std::vector<Cut> cuts;
  for (std::size_t i = 0; i < surface.polygons.size(); ++i) {
    const auto cut = cut_polygon(surface, i, height_m);
    if (!cut) continue;
    plan.obstacles.push_back({cut->left, cut->right});
    if (faces.is_face(i)) cuts.push_back(*cut);
  }
  plan.walls = join(surface, faces, cuts, height_m);
  for (const trace::TriangleMesh& mesh : meshes) add_obstacles(mesh, height_m, plan.obstacles);
  return plan;
}

}  // namespace hallway::sense
