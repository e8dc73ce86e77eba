// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "bsp/compile.hpp"
#include "bsp/point_location.hpp"
#include "support/brushes.hpp"

/// What must hold of every compiled world. Each check gives a complaint, or the empty text.
namespace hallway::test {

inline std::string place_text(const Vec3& at) {
  return format_double(at.x()) + " " + format_double(at.y()) + " " + format_double(at.z());
}

inline Vec3 random_point(std::mt19937_64& random, const Box& box) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const double x = share(random), y = share(random);
  return box.min() + box.sizes().cwiseProduct(Vec3(x, y, share(random)));
}

/// Points that were compared and those too near a face to be.
struct Compared {
  std::size_t all = 0;
  std::size_t near = 0;
};

/// The tree's leaves against the brush list. In a sealed world empty space that the void reaches counts as solid.
inline std::string wrong_content(const map::World& world, const bsp::Compiled& compiled, std::uint64_t seed,
                                 int points, Compared& compared) {
  std::mt19937_64 random(seed);
  for (int i = 0; i < points; ++i) {
    const Vec3 point = random_point(random, compiled.tree.bounds);
    const std::uint32_t index = bsp::leaf_at(compiled.tree, point);
    const bsp::Leaf& leaf = compiled.tree.leaves[index];
    if (!Box(leaf.box.min() - Vec3::Constant(1e-6), leaf.box.max() + Vec3::Constant(1e-6)).contains(point))
      return "a point is not in its leaf's box: " + place_text(point);
    ++compared.all;
    if (near_a_face(world, point, 1e-6)) {
      ++compared.near;
      continue;
    }
    const bool empty = leaf.content == bsp::Content::kEmpty;
    if (empty != (leaf.cluster >= 0)) return "an empty leaf without a cluster, or a solid one with one";
    const bool solid = brushes_solid(world, point);
    if (empty && solid) return "empty leaf in a brush at " + place_text(point);
    if (!empty && !solid && !compiled.enclosure.sealed)
      return "solid leaf in empty space at " + place_text(point);
  }
  return {};
}

inline Vec3 middle_of(const Polygon& polygon) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& vertex : polygon.vertices) sum += vertex;
  return sum / static_cast<double>(polygon.vertices.size());
}

/// The least distance from a point to the lines of the polygon's edges; negative outside.
inline double inset_of(const Polygon& polygon, const Vec3& point) {
  double least = 1e300;
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const Vec3& a = polygon.vertices[i];
    const Vec3 along = (polygon.vertices[(i + 1) % polygon.vertices.size()] - a).normalized();
    least = std::min(least, polygon.plane.normal.cross(along).dot(point - a));
  }
  return least;
}

/// Portals are convex, and what is just in front and behind them are the clusters that they name; or detail.
inline std::string wrong_portal(const map::World& world, const bsp::Compiled& compiled) {
  constexpr double kStep_m = 1e-6;
  std::mt19937_64 random(7);
  for (std::size_t p = 0; p < compiled.portals.portals.size(); ++p) {
    const bsp::Portal& portal = compiled.portals.portals[p];
    const std::string name = "portal " + std::to_string(p) + ": ";
    const std::size_t n = portal.polygon.vertices.size();
    if (n < 3) return name + "has no area";
    if (portal.cluster[0] == portal.cluster[1]) return name + "joins a cluster to itself";
    for (const std::uint32_t cluster : portal.cluster) {
      if (cluster >= compiled.portals.clusters) return name + "names no cluster";
    }
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3& a = portal.polygon.vertices[i];
      const Vec3& b = portal.polygon.vertices[(i + 1) % n];
      const Vec3& c = portal.polygon.vertices[(i + 2) % n];
      if (std::abs(portal.polygon.plane.distance(a)) > 1e-6) return name + "a vertex off its plane";
      if ((b - a).cross(c - b).dot(portal.polygon.plane.normal) <= 0.0) return name + "not strictly convex";
    }
    const Vec3 middle = middle_of(portal.polygon);
    for (int sample = 0; sample < 4; ++sample) {
      std::uniform_real_distribution<double> share(0.0, 0.9);
      const Vec3 point = middle + share(random) * (portal.polygon.vertices[random() % n] - middle);
      if (inset_of(portal.polygon, point) < 10.0 * kStep_m) continue;
      for (const std::size_t side : {0u, 1u}) {
        const Vec3 beside = point + (side == 0 ? kStep_m : -kStep_m) * portal.polygon.plane.normal;
        const std::int32_t there = bsp::cluster_at(compiled.tree, beside);
        if (there == static_cast<std::int32_t>(portal.cluster[side])) continue;
        if (there < 0 && (brushes_solid(world, beside) || near_a_face(world, beside, 2.0 * kStep_m)))
          continue;
        return name + "at " + place_text(beside) + " is cluster " + std::to_string(there) + ", not " +
               std::to_string(portal.cluster[side]);
      }
    }
  }
  return {};
}

/// A part of a segment in one leaf.
struct Stretch {
  double begin = 0.0;
  double end = 1.0;
  std::uint32_t leaf = 0;
};

inline void stretches_of(const bsp::Tree& tree, bsp::Child at, const Vec3& a, const Vec3& b, double begin,
                         double end, std::vector<Stretch>& out) {
  if (at.is_leaf()) {
    out.push_back({begin, end, at.index()});
    return;
  }
  const bsp::Node& node = tree.nodes[at.index()];
  const double da = tree.distance(at, a + begin * (b - a));
  const double db = tree.distance(at, a + end * (b - a));
  if (da >= 0.0 && db >= 0.0) return stretches_of(tree, node.child[0], a, b, begin, end, out);
  if (da < 0.0 && db < 0.0) return stretches_of(tree, node.child[1], a, b, begin, end, out);
  const double cut = begin + (end - begin) * da / (da - db);
  const std::size_t first = da >= 0.0 ? 0 : 1;
  stretches_of(tree, node.child[first], a, b, begin, cut, out);
  stretches_of(tree, node.child[1 - first], a, b, cut, end, out);
}

/// Where a segment goes from a cluster into the next, a portal of the two is passed.
inline std::string missing_portal(const map::World& world, const bsp::Compiled& compiled, std::uint64_t seed,
                                  int segments, double length_m, int& passed) {
  constexpr double kSlack_m = 1e-5;
  std::vector<std::vector<std::uint32_t>> of(compiled.portals.clusters);
  for (std::uint32_t p = 0; p < compiled.portals.portals.size(); ++p) {
    for (const std::uint32_t cluster : compiled.portals.portals[p].cluster) of[cluster].push_back(p);
  }
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Stretch> stretches;
  const Box around(world.bounds.min() - Vec3::Constant(length_m),
                   world.bounds.max() + Vec3::Constant(length_m));
  for (int i = 0; i < segments; ++i) {
    const Vec3 a = random_point(random, around);
    const double x = normal(random), y = normal(random);
    const Vec3 b = a + length_m * Vec3(x, y, normal(random)).normalized();
    if (!compiled.tree.bounds.contains(b) || compiled.tree.nodes.empty()) continue;
    stretches.clear();
    stretches_of(compiled.tree, compiled.tree.root, a, b, 0.0, 1.0, stretches);
    for (std::size_t k = 0; k + 1 < stretches.size(); ++k) {
      const std::int32_t from = compiled.tree.leaves[stretches[k].leaf].cluster;
      const std::int32_t to = compiled.tree.leaves[stretches[k + 1].leaf].cluster;
      if (from == to || from < 0 || to < 0) continue;
      const auto is_short = [&](const Stretch& s) { return (s.end - s.begin) * length_m < 10.0 * kSlack_m; };
      if (is_short(stretches[k]) || is_short(stretches[k + 1])) continue;  // past an edge: rounding decides
      const Vec3 at = a + stretches[k].end * (b - a);
      bool found = false;
      for (const std::uint32_t p : of[static_cast<std::size_t>(from)]) {
        const bsp::Portal& portal = compiled.portals.portals[p];
        const auto other = static_cast<std::uint32_t>(to);
        if (portal.cluster[0] != other && portal.cluster[1] != other) continue;
        found = found || (std::abs(portal.polygon.plane.distance(at)) < kSlack_m &&
                          inset_of(portal.polygon, at) > -kSlack_m);
      }
      if (!found)
        return "no portal between clusters " + std::to_string(from) + " and " + std::to_string(to) + " at " +
               place_text(at);
      ++passed;
    }
  }
  return {};
}

/// A polygon before which there is an empty leaf is marked as inside and named by that leaf; one that has none is not.
inline std::string wrong_inside_flag(const map::World& world, const bsp::Compiled& compiled) {
  if (compiled.inside.size() != compiled.surface.polygons.size()) return "flags for other polygons";
  for (std::size_t i = 0; i < compiled.surface.polygons.size(); ++i) {
    const csg::SurfacePolygon& polygon = compiled.surface.polygons[i];
    for (const auto& corners : csg::triangulate(compiled.surface, polygon)) {
      const Vec3& a = compiled.surface.vertices[corners[0]];
      const Vec3& b = compiled.surface.vertices[corners[1]];
      const Vec3& c = compiled.surface.vertices[corners[2]];
      const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
      if ((b - a).cross(c - a).norm() / longest < 1e-3) continue;
      const Vec3 before = a + 0.3472963 * (b - a) + 0.2909038 * (c - a) + 4e-6 * polygon.plane.normal;
      if (near_a_face(world, before, 2e-6)) continue;
      const bsp::Leaf& leaf = compiled.tree.leaves[bsp::leaf_at(compiled.tree, before)];
      if (leaf.content != bsp::Content::kEmpty) continue;
      const std::string name = "polygon " + std::to_string(i) + ", before it at " + place_text(before) + ": ";
      if (!compiled.inside[i]) return name + "an empty leaf, but not marked";
      bool named = false;
      for (std::uint32_t k = 0; k < leaf.face_count; ++k)
        named = named || compiled.tree.leaf_faces[leaf.first_face + k] == i;
      if (!named) return name + "the leaf does not name it";
    }
  }
  for (const bsp::Leaf& leaf : compiled.tree.leaves) {
    for (std::uint32_t k = 0; k < leaf.face_count; ++k) {
      if (leaf.content != bsp::Content::kEmpty) return "a solid leaf with faces";
      if (!compiled.inside[compiled.tree.leaf_faces[leaf.first_face + k]])
        return "a leaf's face is not marked";
    }
  }
  return {};
}

}  // namespace hallway::test
