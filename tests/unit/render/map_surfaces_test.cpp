// SPDX-License-Identifier: MIT
#include "render/map_surfaces.hpp"

#include <gtest/gtest.h>

#include "unit/render/scenes.hpp"

namespace hallway::render {
namespace {

TEST(MapSurfaces, EveryFaceOfEverySolidWithItsMaterial) {
  std::vector<Surface> box;
  test::add_box(box, {0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}, {});
  map::World world;
  for (const char* material : {"floor", "brick"}) {
    map::Solid solid;
    for (const Surface& face : box) solid.faces.push_back({face.polygon, material, 1});
    world.solids.push_back(solid);
  }
  const std::vector<Surface> surfaces = map_surfaces(world);
  ASSERT_EQ(surfaces.size(), 12u);
  EXPECT_EQ(surfaces.front().colour, material_colour("floor"));
  EXPECT_EQ(surfaces.back().colour, material_colour("brick"));
  EXPECT_EQ(surfaces[7].polygon.vertices, box[1].polygon.vertices);
}

TEST(MapSurfaces, PlanCutsAboveTheFloorOfARoom) {
  const auto cut = plan_cut_height(test::office().surfaces, 1.2);
  ASSERT_TRUE(cut);
  EXPECT_DOUBLE_EQ(*cut, 1.2);
}

TEST(MapSurfaces, OpenGroundNeedsNoCut) {
  std::vector<Surface> surfaces;
  test::add_box(surfaces, {0.0, 0.0, -1.0}, {10.0, 10.0, 0.0}, {});
  test::add_box(surfaces, {2.0, 2.0, 0.0}, {3.0, 3.0, 4.0}, {});
  EXPECT_FALSE(plan_cut_height(surfaces));
  EXPECT_FALSE(plan_cut_height({}));
}

}  // namespace
}  // namespace hallway::render
