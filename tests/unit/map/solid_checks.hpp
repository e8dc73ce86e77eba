// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "map/world.hpp"

namespace hallway::map::test {

using Point = std::array<double, 3>;

inline Point exact(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

/// Volume by the divergence theorem over the polygons, taken as fans.
inline double volume(const Solid& solid) {
  const Vec3 centre = solid.box.center();
  double sum = 0.0;
  for (const SolidFace& face : solid.faces) {
    const auto& v = face.polygon.vertices;
    for (std::size_t i = 1; i + 1 < v.size(); ++i) {
      sum += (v[0] - centre).dot((v[i] - centre).cross(v[i + 1] - centre)) / 6.0;
    }
  }
  return sum;
}

/// Expects that each edge of each polygon is run along once in each direction, with the very same end points.
inline void expect_closed(const Solid& solid) {
  std::set<std::pair<Point, Point>> edges;
  for (const SolidFace& face : solid.faces) {
    const auto& v = face.polygon.vertices;
    for (std::size_t i = 0; i < v.size(); ++i) {
      EXPECT_TRUE(edges.insert({exact(v[i]), exact(v[(i + 1) % v.size()])}).second)
          << "an edge runs twice the same way";
    }
  }
  for (const auto& [a, b] : edges) EXPECT_TRUE(edges.count({b, a})) << "an edge has no other side";
}

/// Expects that vertices lie on their plane and behind all others, that polygons turn counter-clockwise about their normal
/// and have an area.
inline void expect_sound_faces(const Solid& solid, double tolerance_m) {
  for (const SolidFace& face : solid.faces) {
    const auto& v = face.polygon.vertices;
    ASSERT_GE(v.size(), 3u);
    EXPECT_NEAR(face.polygon.plane.normal.norm(), 1.0, 1e-12);
    Vec3 twice_area = Vec3::Zero();
    for (std::size_t i = 0; i < v.size(); ++i) {
      twice_area += (v[i] - v[0]).cross(v[(i + 1) % v.size()] - v[0]);
      EXPECT_NEAR(face.polygon.plane.distance(v[i]), 0.0, tolerance_m);
      for (const Plane& plane : solid.planes) EXPECT_LE(plane.distance(v[i]), tolerance_m);
    }
    EXPECT_GT(twice_area.dot(face.polygon.plane.normal), 0.0);
  }
}

}  // namespace hallway::map::test
