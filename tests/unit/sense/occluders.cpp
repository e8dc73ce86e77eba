// SPDX-License-Identifier: MIT
#include "sense/occluders.hpp"

#include <gtest/gtest.h>

#include "map/world.hpp"
#include "unit/sense/map_text.hpp"

namespace hallway::sense {
namespace {

double area_of(const trace::TriangleMesh& mesh) {
  double area = 0.0;
  for (const auto& corner : mesh.triangles) {
    const Vec3& a = mesh.vertices[corner[0]];
    area += 0.5 * (mesh.vertices[corner[1]] - a).cross(mesh.vertices[corner[2]] - a).norm();
  }
  return area;
}

csg::Surface surface_of(const std::vector<std::string>& brushes) {
  return csg::build_surface(map::build_world(test::parse_map(test::worldspawn({}, brushes))));
}

TEST(Occluders, AreAllFacesOfSeparateSolids) {
  const trace::TriangleMesh mesh = make_occluders(
      surface_of({test::box_brush({0, 0, 0}, {1, 2, 3}), test::box_brush({5, 0, 0}, {6, 1, 1})}));
  EXPECT_EQ(mesh.triangles.size(), 24u);
  EXPECT_NEAR(area_of(mesh), 2.0 * (2 + 3 + 6) + 6.0, 1e-12);
}

TEST(Occluders, HaveNoFacesInsideOfSolids) {
  const trace::TriangleMesh mesh = make_occluders(
      surface_of({test::box_brush({0, 0, 0}, {1, 2, 3}), test::box_brush({1, 0, 0}, {2, 2, 3})}));
  EXPECT_NEAR(area_of(mesh), 2.0 * (2 * 2 + 2 * 3 + 2 * 3), 1e-12);
}

TEST(Occluders, AreFollowedByTheMeshes) {
  const csg::Surface surface = surface_of({test::box_brush({0, 0, 0}, {1, 2, 3})});
  trace::TriangleMesh one;
  one.vertices = {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
  one.triangles = {{0, 1, 2}};
  const std::vector<trace::TriangleMesh> meshes = {one, one};
  const trace::TriangleMesh all = make_occluders(surface, meshes);
  ASSERT_EQ(all.triangles.size(), 14u);
  for (const std::size_t i : {12u, 13u}) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(all.vertices[all.triangles[i][k]], one.vertices[k]);
  }
  EXPECT_EQ(make_occluders(csg::Surface{}).triangles.size(), 0u);
}

}  // namespace
}  // namespace hallway::sense
