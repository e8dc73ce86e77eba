// SPDX-License-Identifier: MIT
#include "sense/face_plan.hpp"

#include <gtest/gtest.h>

namespace hallway::sense {
namespace {

/// A surface of upright rectangles in the plane x = 0, given by y and z; they share vertices where they touch.
class WallDrawing {
 public:
  void add(double y0, double y1, double z0, double z1, const std::vector<Vec2>& between = {}) {
    csg::SurfacePolygon polygon;
    polygon.plane = {-Vec3::UnitX(), 0.0};
    std::vector<Vec2> corners{{y1, z0}, {y0, z0}, {y0, z1}, {y1, z1}};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      polygon.vertices.push_back(vertex(corners[i]));
      for (const Vec2& p : between) {  // a neighbour's corner on an edge
        const Vec2 way = corners[(i + 1) % 4] - corners[i], to = p - corners[i];
        if (way.x() * to.y() == way.y() * to.x() && to.dot(way) > 0.0 && to.norm() < way.norm())
          polygon.vertices.push_back(vertex(p));
      }
    }
    surface.polygons.push_back(polygon);
  }

  csg::Surface surface;

 private:
  std::uint32_t vertex(const Vec2& p) {
    const Vec3 at(0.0, p.x(), p.y());
    for (std::uint32_t i = 0; i < surface.vertices.size(); ++i) {
      if (surface.vertices[i] == at) return i;
    }
    surface.vertices.push_back(at);
    return static_cast<std::uint32_t>(surface.vertices.size() - 1);
  }
};

TEST(FacePlan, PartsOfAConvexFaceAreOneHoweverItIsCut) {
  WallDrawing wall;
  wall.add(0, 2, 0, 1, {{1, 1}});
  wall.add(0, 1, 1, 2);
  wall.add(1, 2, 1, 2);
  const FacePlan plan = make_face_plan(wall.surface, {});
  ASSERT_EQ(plan.faces.size(), 1u);
  EXPECT_EQ(plan.faces[0].vertices.size(), 4u);
  EXPECT_EQ(plan.obstacles.size(), 3u);
}

TEST(FacePlan, AWallWithADoorIsThreeFaces) {
  WallDrawing wall;
  wall.add(0, 2, 0, 3, {{2, 2}});
  wall.add(2, 3, 2, 3);
  wall.add(3, 5, 0, 3, {{3, 2}});
  const FacePlan plan = make_face_plan(wall.surface, {});
  EXPECT_EQ(plan.faces.size(), 3u);
  for (const Polygon& face : plan.faces) EXPECT_EQ(face.vertices.size(), 4u);
}

TEST(FacePlan, WhatIsNotWantedHidesButIsNoFace) {
  WallDrawing wall;
  wall.add(0, 1, 0, 1);
  wall.add(4, 5, 0, 1);
  const FacePlan plan = make_face_plan(wall.surface, [](std::size_t i) { return i == 1; });
  EXPECT_EQ(plan.faces.size(), 1u);
  EXPECT_EQ(plan.obstacles.size(), 2u);
}

}  // namespace
}  // namespace hallway::sense
