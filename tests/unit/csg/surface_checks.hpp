// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "csg/surface.hpp"
#include "map/world.hpp"
#include "support/brushes.hpp"

/// What must hold of every surface. Each check gives a complaint, or the empty text.
namespace hallway::test {

using Triangle = std::array<Vec3, 3>;

inline std::vector<Triangle> triangles_of(const csg::Surface& surface) {
  std::vector<Triangle> triangles;
  for (const csg::SurfacePolygon& polygon : surface.polygons) {
    if (polygon.vertices.empty()) continue;
    for (const auto& corners : csg::triangulate(surface, polygon)) {
      triangles.push_back(
          {surface.vertices[corners[0]], surface.vertices[corners[1]], surface.vertices[corners[2]]});
    }
  }
  return triangles;
}

/// By the divergence theorem, about the point `centre`.
inline double volume_of(const std::vector<Triangle>& triangles, const Vec3& centre) {
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles) sum += (a - centre).dot((b - centre).cross(c - centre)) / 6.0;
  return sum;
}

inline double volume_of(const csg::Surface& surface) {
  const Vec3 centre = surface.vertices.empty() ? Vec3::Zero() : surface.vertices.front();
  return volume_of(triangles_of(surface), centre);
}

/// How often the triangles wind around a point: the sum of the solid angles they fill, over 4 pi (van Oosterom and Strackee, 1983).
inline double winding_number(const std::vector<Triangle>& triangles, const Vec3& point) {
  double sum = 0.0;
  for (const Triangle& triangle : triangles) {
    const Vec3 a = triangle[0] - point, b = triangle[1] - point, c = triangle[2] - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4.0 * std::numbers::pi);
}

using DirectedEdges = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

inline DirectedEdges edges_of(const csg::Surface& surface) {
  DirectedEdges edges;
  for (const csg::SurfacePolygon& polygon : surface.polygons) {
    const std::size_t n = polygon.vertices.size();
    for (std::size_t i = 0; i < n; ++i) ++edges[{polygon.vertices[i], polygon.vertices[(i + 1) % n]}];
  }
  return edges;
}

inline std::string text_of(const csg::Surface& surface, std::pair<std::uint32_t, std::uint32_t> edge) {
  const auto text = [&](std::uint32_t v) {
    const Vec3& at = surface.vertices[v];
    return "(" + format_double(at.x()) + " " + format_double(at.y()) + " " + format_double(at.z()) + ")";
  };
  return text(edge.first) + " -> " + text(edge.second);
}

/// Along every edge the directed sides cancel.
inline std::string not_closed(const csg::Surface& surface) {
  const DirectedEdges edges = edges_of(surface);
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (back == edges.end() || back->second != count)
      return "not closed along " + text_of(surface, edge) + ": " + std::to_string(count) + " against " +
             std::to_string(back == edges.end() ? 0 : back->second);
  }
  return {};
}

/// Every edge is run along once in each direction.
inline std::string not_manifold(const csg::Surface& surface) {
  for (const auto& [edge, count] : edges_of(surface)) {
    if (count != 1) return std::to_string(2 * count) + " polygons meet along " + text_of(surface, edge);
  }
  return {};
}

/// Each polygon lies on the face that it names, looks the right way, turns left at every corner and has an area.
inline std::string unsound_polygon(const map::World& world, const csg::Surface& surface, double tolerance_m) {
  for (std::size_t i = 0; i < surface.polygons.size(); ++i) {
    const csg::SurfacePolygon& polygon = surface.polygons[i];
    const std::string name = "polygon " + std::to_string(i) + ": ";
    if (polygon.solid >= world.solids.size()) return name + "no such solid";
    const map::Solid& solid = world.solids[polygon.solid];
    if (polygon.face >= solid.faces.size()) return name + "no such face";
    const Plane& face = solid.faces[polygon.face].polygon.plane;
    const double sign = solid.role == map::BrushRole::kSubtract ? -1.0 : 1.0;
    if ((polygon.plane.normal - sign * face.normal).norm() > 1e-4)
      return name + "looks elsewhere than its face";
    const std::size_t n = polygon.vertices.size();
    if (n == 1 || n == 2) return name + "has " + std::to_string(n) + " vertices";
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3& a = surface.vertices[polygon.vertices[k]];
      const Vec3& b = surface.vertices[polygon.vertices[(k + 1) % n]];
      const Vec3& c = surface.vertices[polygon.vertices[(k + 2) % n]];
      if (std::abs(face.distance(a)) > tolerance_m)
        return name + "a vertex is " + format_double(face.distance(a)) + " m off its face";
      if ((b - a).cross(c - b).dot(polygon.plane.normal) < -tolerance_m * ((b - a).norm() + (c - b).norm()))
        return name + "is not convex";
    }
  }
  return {};
}

/// No vertex lies inside of an edge of a polygon. O(vertices * edges).
inline std::string t_junction(const csg::Surface& surface, double distance_m) {
  for (const auto& [edge, count] : edges_of(surface)) {
    const Vec3& a = surface.vertices[edge.first];
    const Vec3 along = surface.vertices[edge.second] - a;
    for (std::uint32_t v = 0; v < surface.vertices.size(); ++v) {
      if (v == edge.first || v == edge.second) continue;
      const Vec3 offset = surface.vertices[v] - a;
      const double place = offset.dot(along) / along.squaredNorm();
      if (place <= 0.0 || place >= 1.0) continue;
      if ((offset - place * along).norm() < distance_m) return "a vertex inside of " + text_of(surface, edge);
    }
  }
  return {};
}

/// Beside each polygon: in front there is nothing, behind solid, and no later brush holds it: that one would own it. Thin polygons are passed
/// over.
inline std::string wrong_owner(const map::World& world, const csg::Surface& surface, double thin_m) {
  for (std::size_t i = 0; i < surface.polygons.size(); ++i) {
    const csg::SurfacePolygon& polygon = surface.polygons[i];
    if (polygon.vertices.empty()) continue;
    for (const auto& corners : csg::triangulate(surface, polygon)) {
      const Vec3 &a = surface.vertices[corners[0]], &b = surface.vertices[corners[1]],
                 &c = surface.vertices[corners[2]];
      const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
      if ((b - a).cross(c - a).norm() / longest < 10.0 * thin_m) continue;
      // Not the very middle, on which edges of other brushes like to stand.
      const Vec3 middle = a + 0.3472963 * (b - a) + 0.2909038 * (c - a);
      const std::string name = "polygon " + std::to_string(i) + ": ";
      for (std::size_t later = polygon.solid + 1; later < world.solids.size(); ++later) {
        if (world.solids[later].role == map::BrushRole::kHint) continue;
        // Around the middle, that is: a brush that touches the polygon in a line has no part of it.
        const map::Solid& other = world.solids[later];
        if (other.contains(middle + 0.01 * (a - middle), -1e-9) &&
            other.contains(middle + 0.01 * (b - middle), -1e-9) &&
            other.contains(middle + 0.01 * (c - middle), -1e-9))
          return name + "belongs to solid " + std::to_string(polygon.solid) + ", but " +
                 std::to_string(later) + " holds " + format_double(middle.x()) + " " +
                 format_double(middle.y()) + " " + format_double(middle.z());
      }
      const Vec3 step = thin_m * polygon.plane.normal;
      if (!near_a_face(world, middle + step, 0.1 * thin_m) && brushes_solid(world, middle + step))
        return name + "solid in front";
      if (!near_a_face(world, middle - step, 0.1 * thin_m) && !brushes_solid(world, middle - step))
        return name + "empty behind";
    }
  }
  return {};
}

}  // namespace hallway::test
