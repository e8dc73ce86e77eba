// SPDX-License-Identifier: MIT
#include "sense/occluders.hpp"

#include <gtest/gtest.h>

#include "unit/sense/map_text.hpp"

namespace hallway::sense {
namespace {

TEST(Occluders, AreAllFacesOfAllSolids) {
  const map::Document document = test::parse_map(
      test::worldspawn({}, {test::box_brush({0, 0, 0}, {1, 2, 3}), test::box_brush({5, 0, 0}, {6, 1, 1})}));
  const trace::TriangleMesh mesh = make_occluders(map::build_world(document));
  EXPECT_EQ(mesh.triangles.size(), 24u);
  double area = 0.0;
  for (const auto& corner : mesh.triangles) {
    const Vec3& a = mesh.vertices[corner[0]];
    area += 0.5 * (mesh.vertices[corner[1]] - a).cross(mesh.vertices[corner[2]] - a).norm();
  }
  EXPECT_NEAR(area, 2.0 * (2 + 3 + 6) + 6.0, 1e-12);
}

}  // namespace
}  // namespace hallway::sense
