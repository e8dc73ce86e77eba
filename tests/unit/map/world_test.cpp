// SPDX-License-Identifier: MIT
#include "map/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <vector>

#include <Eigen/LU>

#include "map/reader.hpp"
#include "map_text.hpp"
#include "solid_checks.hpp"
#include "support/long_mode.hpp"

namespace hallway::map {
namespace {

using test::cube_faces;
using test::document_of;
using test::half_space;
using test::map_of;

const Solid& only_solid(const World& world) {
  EXPECT_TRUE(world.problems.empty()) << world.problems.front().message;
  EXPECT_EQ(world.solids.size(), 1u);
  return world.solids.at(0);
}

/// Brushes around the origin: half-spaces whose planes touch a sphere of 10 to 100 units, enough of them to be closed.
Brush random_brush(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> radius(10.0, 100.0);
  Brush brush;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0})
      brush.faces.push_back(half_space(sign * Vec3::Unit(axis), 100.0, 64.0));
  }
  const int more = static_cast<int>(random() % 10);
  for (int i = 0; i < more; ++i) {
    const double x = normal(random);
    const double y = normal(random);
    brush.faces.push_back(half_space(Vec3(x, y, normal(random)), radius(random), 64.0));
  }
  return brush;
}

/// Volume from all triples of planes: the vertices behind all planes, and each plane's share ordered by angle.
double volume_by_triples(const Brush& brush) {
  std::vector<Plane> planes;
  for (const Face& face : brush.faces) {
    const Vec3 n = (face.points[2] - face.points[0]).cross(face.points[1] - face.points[0]).normalized();
    planes.push_back({n, n.dot(face.points[0])});
  }
  std::vector<Vec3> vertices;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        Eigen::Matrix3d normals;
        normals << planes[i].normal.transpose(), planes[j].normal.transpose(), planes[k].normal.transpose();
        if (std::abs(normals.determinant()) < 1e-9) continue;
        const Vec3 point = normals.inverse() * Vec3(planes[i].offset, planes[j].offset, planes[k].offset);
        if (std::all_of(planes.begin(), planes.end(),
                        [&](const Plane& p) { return p.distance(point) < 1e-7; })) {
          vertices.push_back(point);
        }
      }
    }
  }
  double volume = 0.0;
  for (const Plane& plane : planes) {
    const Vec3 u = plane.normal.unitOrthogonal();
    const Vec3 v = plane.normal.cross(u);
    std::vector<Vec2> corners;
    Vec2 centre = Vec2::Zero();
    for (const Vec3& vertex : vertices) {
      if (std::abs(plane.distance(vertex)) < 1e-7) corners.push_back({u.dot(vertex), v.dot(vertex)});
    }
    if (corners.size() < 3) continue;
    for (const Vec2& corner : corners) centre += corner / static_cast<double>(corners.size());
    std::sort(corners.begin(), corners.end(), [&](const Vec2& a, const Vec2& b) {
      return std::atan2(a.y() - centre.y(), a.x() - centre.x()) <
             std::atan2(b.y() - centre.y(), b.x() - centre.x());
    });
    double area = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 a = corners[i] - centre;
      const Vec2 b = corners[(i + 1) % corners.size()] - centre;
      area += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
    volume += plane.offset * area / 3.0;
  }
  return volume;
}

TEST(World, ACubeInMetres) {
  const World world = build_world(parse(map_of(cube_faces()), "a.map"));
  const Solid& solid = only_solid(world);
  EXPECT_EQ(solid.faces.size(), 6u);
  EXPECT_EQ(solid.line, 3);
  EXPECT_EQ(solid.faces[0].line, 4);
  EXPECT_EQ(solid.faces[0].material, "wall");
  EXPECT_EQ(solid.planes[0].normal, -Vec3::UnitX());
  EXPECT_EQ(solid.planes[0].offset, 2.0);
  EXPECT_EQ(world.bounds.min(), Vec3::Constant(-2.0));
  EXPECT_EQ(world.bounds.max(), Vec3::Constant(2.0));
  EXPECT_EQ(test::volume(solid), 64.0);
  test::expect_closed(solid);
  test::expect_sound_faces(solid, 0.0);
}

TEST(World, ScaleIsTheMaps) {
  std::string text = map_of(cube_faces());
  text.insert(text.find("{\n( "), "\"_scale\" \"0.01\"\n");
  EXPECT_EQ(build_world(parse(text, "a.map")).bounds.max(), Vec3::Constant(0.64));
}

TEST(World, OnlyWorldspawnAndGroupsAreSolid) {
  const std::string brush = "{\n" + cube_faces() + "}\n";
  const auto entity = [&](const std::string& name) {
    return "{\n\"classname\" \"" + name + "\"\n" + brush + "}\n";
  };
  const World world = build_world(parse(
      entity("worldspawn") + entity("func_door") + entity("func_group") + "{\n" + brush + "}\n", "a.map"));
  ASSERT_EQ(world.solids.size(), 2u);
  EXPECT_EQ(world.solids[0].entity, 0);
  EXPECT_EQ(world.solids[1].entity, 2);
}

TEST(World, ContainsIsInsideAllPlanes) {
  const World world = build_world(parse(map_of(cube_faces()), "a.map"));
  const Solid& solid = only_solid(world);
  EXPECT_TRUE(solid.contains(Vec3(1.9, 0, 0)));
  EXPECT_FALSE(solid.contains(Vec3(2.1, 0, 0)));
  EXPECT_FALSE(solid.contains(Vec3(1.9, 0, 0), 0.2));
  EXPECT_TRUE(solid.contains(Vec3(2.1, 0, 0), -0.2));
}

TEST(World, APlaneThatOnlyTouchesHasNoFace) {
  const World world =
      build_world(parse(map_of(cube_faces() + test::face_line("( 96 0 0 ) ( 96 0 1 ) ( 96 1 0 )")), "a.map"));
  EXPECT_EQ(only_solid(world).faces.size(), 6u);
}

TEST(World, RandomBrushesAreClosedAndHaveTheirVolume) {
  std::mt19937_64 random(7);
  const int count = hallway::test::sized(300, 20000);
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE(i);
    const Brush brush = random_brush(random);
    const World world = build_world(document_of(brush));
    const Solid& solid = only_solid(world);
    test::expect_closed(solid);
    test::expect_sound_faces(solid, 1e-7);
    const double expected = volume_by_triples(brush);
    EXPECT_NEAR(test::volume(solid), expected, 1e-9 * expected);
  }
}

TEST(World, RandomBrushesAMillionUnitsAwayKeepTheirVolume) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    Brush brush = random_brush(random);
    const double expected = volume_by_triples(brush);
    for (Face& face : brush.faces) {
      for (Vec3& point : face.points) point += Vec3(1e6, -1e6, 1e6);
    }
    const World world = build_world(document_of(brush));
    const Solid& solid = only_solid(world);
    test::expect_closed(solid);
    EXPECT_NEAR(test::volume(solid), expected, 1e-8 * expected);
  }
}

TEST(World, TheOrderOfFacesDoesNotChangeTheBody) {
  std::mt19937_64 random(9);
  for (int i = 0; i < 100; ++i) {
    Brush brush = random_brush(random);
    const double volume = test::volume(only_solid(build_world(document_of(brush))));
    std::shuffle(brush.faces.begin(), brush.faces.end(), random);
    const World world = build_world(document_of(brush));
    test::expect_closed(only_solid(world));
    EXPECT_NEAR(test::volume(only_solid(world)), volume, 1e-9 * volume);
  }
}

TEST(World, APrismOfManySides) {
  constexpr int kSides = 1000;
  Brush brush;
  brush.faces = {half_space(Vec3::UnitZ(), 10.0), half_space(-Vec3::UnitZ(), 10.0)};
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSides;
    brush.faces.push_back(half_space(Vec3(std::cos(angle), std::sin(angle), 0.0), 1000.0, 10.0));
  }
  const World world = build_world(document_of(brush));
  const Solid& solid = only_solid(world);
  EXPECT_EQ(solid.faces.size(), kSides + 2u);
  test::expect_closed(solid);
  const double expected = 20.0 * kSides * 1e6 * std::tan(std::numbers::pi / kSides);
  EXPECT_NEAR(test::volume(solid), expected, 1e-7 * expected);
}

}  // namespace
}  // namespace hallway::map
