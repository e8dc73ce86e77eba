// SPDX-License-Identifier: MIT
#include "render/map_surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "map/reader.hpp"
#include "render/draw.hpp"
#include "support/room_maps.hpp"

namespace hallway::render {
namespace {

/// A map that is compiled with somebody in it.
struct Building {
  explicit Building(const std::string& text, const Vec3& occupant = {1.0, 1.0, 1.0})
      : world(map::build_world(map::parse(text, "test.map"))) {
    compiled = bsp::compile(world, {occupant}, {});
  }
  map::World world;
  bsp::Compiled compiled;
};

/// A block with rooms cut out of it, in map units of a centimetre.
std::string block(const std::string& rooms, const test::Units& low, const test::Units& high) {
  return "{\n\"classname\" \"worldspawn\"\n\"_scale\" \"0.01\"\n" + test::box_brush(low, high, "concrete") +
         "}\n{\n\"classname\" \"hw_subtract\"\n" + rooms + "}\n";
}

Box box_of(const std::vector<Surface>& surfaces) {
  Box box;
  for (const Surface& surface : surfaces) {
    for (const Vec3& corner : surface.polygon.vertices) box.extend(corner);
  }
  return box;
}

TEST(MapSurfaces, FacesOfTheBoundaryWithTheMaterialsOfTheirBrushes) {
  const Building room(
      block(test::box_brush({0, 0, 0}, {400, 300, 300}, "brick"), {-50, -50, -50}, {450, 350, 350}));
  const std::vector<Surface> all = map_surfaces(room.world, room.compiled, Faces::kAll);
  ASSERT_EQ(all.size(), 12u);
  for (const Surface& surface : all) {
    Box box;
    for (const Vec3& corner : surface.polygon.vertices) box.extend(corner);
    const bool inner = Box(Vec3(0, 0, 0), Vec3(4, 3, 3)).contains(box);
    EXPECT_EQ(surface.colour, material_colour(inner ? "brick" : "concrete"));
    // The normal looks from the solid into the empty side.
    EXPECT_EQ(surface.polygon.plane.normal.dot(box.center() - Vec3(2, 1.5, 1.5)) < 0.0, inner);
  }
}

TEST(MapSurfaces, InsideLeavesOutTheShell) {
  const Building room(
      block(test::box_brush({0, 0, 0}, {400, 300, 300}, "brick"), {-50, -50, -50}, {450, 350, 350}));
  const std::vector<Surface> inside = map_surfaces(room.world, room.compiled, Faces::kInside);
  EXPECT_EQ(inside.size(), 6u);
  EXPECT_TRUE(box_of(inside).isApprox(Box(Vec3(0, 0, 0), Vec3(4, 3, 3))));
}

TEST(MapSurfaces, FaceIsDividedWhereColoursMeetOnly) {
  const Building building(test::two_rooms(), {50.0, 50.0, 50.0});  // outside, so that the void is divided too
  const std::size_t plain = map_surfaces(building.world, building.compiled, Faces::kAll).size();
  const LeafColour one = [](std::uint32_t, Rgb) { return Rgb{1, 2, 3}; };
  EXPECT_EQ(map_surfaces(building.world, building.compiled, Faces::kInside, one).size(),
            map_surfaces(building.world, building.compiled, Faces::kInside).size());
  const LeafColour each = [](std::uint32_t leaf, Rgb) { return Rgb{static_cast<std::uint8_t>(leaf), 0, 0}; };
  EXPECT_GT(map_surfaces(building.world, building.compiled, Faces::kAll, each).size(), plain);
}

TEST(MapSurfaces, FacesThatAreNotDrawnStillCloseTheSolid) {
  const Building room(
      block(test::box_brush({0, 0, 0}, {400, 300, 300}, "skip"), {-50, -50, -50}, {450, 350, 350}));
  const std::vector<Surface> all = map_surfaces(room.world, room.compiled, Faces::kAll);
  ASSERT_EQ(all.size(), 12u);
  const auto unseen = std::count_if(
      all.begin(), all.end(), [](const Surface& surface) { return surface.kind == SurfaceKind::kUnseen; });
  EXPECT_EQ(unseen, 6);
}

// ---- plans ----------------------------------------------------------------------------------------------------------

TEST(Plan, CutsAboveTheFloorOfRoomsAtOneHeight) {
  const Plan plan = plan_of(Building(test::two_rooms()).compiled, {}, 1.2);
  EXPECT_EQ(plan.faces, Faces::kAll);
  ASSERT_TRUE(plan.cut_z_m);
  EXPECT_NEAR(*plan.cut_z_m, 1.2, 1e-9);
}

TEST(Plan, ShowsTheInsideOfRoomsAtManyHeights) {
  std::string rooms;
  for (int i = 0; i < 4; ++i) {
    rooms += test::box_brush({500 * i, 0, 400 * i}, {500 * i + 400, 300, 400 * i + 300}, "wall");
  }
  const Plan plan = plan_of(Building(block(rooms, {-100, -100, -100}, {2100, 400, 1700})).compiled);
  EXPECT_EQ(plan.faces, Faces::kInside);
  EXPECT_FALSE(plan.cut_z_m);
}

TEST(Plan, OpenGroundNeedsNoCut) {
  const std::string ground = "{\n\"classname\" \"worldspawn\"\n\"_scale\" \"0.01\"\n" +
                             test::box_brush({0, 0, -100}, {1000, 1000, 0}, "ground") +
                             test::box_brush({200, 200, 0}, {300, 300, 400}, "wall") + "}\n";
  EXPECT_FALSE(plan_of(Building(ground).compiled).cut_z_m);
  EXPECT_FALSE(plan_of(Building("{\n\"classname\" \"worldspawn\"\n}\n").compiled).cut_z_m);
}

TEST(Plan, OfALeakingMapOpensTheStoreyAskedFor) {
  std::string rooms;
  for (int i = 0; i < 3; ++i)
    rooms += test::box_brush({500 * i, 0, 400 * i}, {500 * i + 400, 300, 400 * i + 300}, "wall");
  rooms += test::box_brush({-100, 100, 100}, {0, 200, 200}, "wall");
  const map::World world =
      map::build_world(map::parse(block(rooms, {-100, -100, -100}, {1500, 400, 1300}), "test.map"));
  const bsp::Compiled compiled = bsp::compile(world, {Vec3(2, 1.5, 1)}, {});
  ASSERT_FALSE(compiled.enclosure.sealed);
  EXPECT_NEAR(*plan_of(compiled, Vec3(7.0, 1.5, 5.0)).cut_z_m, 5.2, 1e-9);
  EXPECT_NEAR(*plan_of(compiled, Vec3(12.0, 1.5, 9.0)).cut_z_m, 9.2, 1e-9);
}

// ---- meshes ---------------------------------------------------------------------------------------------------------

/// A square of 2 m in the plane z = 0 whose left half has a red picture and whose right half a green one.
mesh::Model textured_square() {
  mesh::Model model;
  model.images.push_back(
      {.name = "halves", .width = 2, .height = 1, .rgba = {200, 0, 0, 255, 0, 200, 0, 255}});
  model.materials.push_back({.name = "painted", .base_colour = {1.0f, 0.5f, 1.0f, 1.0f}, .image = 0});
  for (const double x : {0.0, 1.0, 2.0}) {
    for (const double y : {0.0, 2.0}) {
      model.vertices.push_back({x, y, 0.0});
      model.uv.push_back({static_cast<float>(x / 2.0), static_cast<float>(y / 2.0)});
    }
  }
  model.triangles = {{{0, 2, 3}, 0}, {{0, 3, 1}, 0}, {{2, 4, 5}, 0}, {{2, 5, 3}, 0}};
  return model;
}

std::vector<Surface> surfaces_of(const mesh::Model& model) {
  return mesh_surfaces(model, model_textures(model.images), mesh::place(model, {}));
}

TEST(MeshSurfaces, TrianglesHaveTheirPictureAndTheBaseColour) {
  mesh::Model model = textured_square();
  model.materials.push_back({.name = "plain", .base_colour = {0.0f, 1.0f, 0.2f, 1.0f}});
  model.triangles[3].material = 1;
  const std::vector<Surface> surfaces = surfaces_of(model);
  ASSERT_EQ(surfaces.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(surfaces[i].kind, SurfaceKind::kSheet);
    EXPECT_NEAR(surfaces[i].polygon.plane.normal.z(), 1.0, 1e-12);
    EXPECT_EQ(surfaces[i].colour, (i < 3 ? Rgb{255, 128, 255} : Rgb{0, 255, 51}));
    ASSERT_EQ(surfaces[i].texture != nullptr, i < 3);
    if (i == 3) continue;
    EXPECT_EQ(surfaces[i].texture, surfaces[0].texture);
    EXPECT_EQ(surfaces[i].texture->rgba, model.images[0].rgba);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& corner = surfaces[i].polygon.vertices[k];
      EXPECT_EQ(surfaces[i].uv.at(k)[0], static_cast<float>(corner.x() / 2.0));
      EXPECT_EQ(surfaces[i].uv.at(k)[1], static_cast<float>(corner.y() / 2.0));
    }
  }
  model.uv.clear();
  EXPECT_EQ(surfaces_of(model)[0].texture, nullptr);
}

TEST(MeshSurfaces, AreSeenFromBothSidesAndCutNothing) {
  const mesh::Model model = textured_square();
  Picture picture;
  picture.surfaces = surfaces_of(model);
  for (const double height : {3.0, -3.0}) {
    View view;
    view.kind = ViewKind::kPerspective;
    view.eye = Vec3(0.5, 1.0, height);
    view.target = Vec3(0.5, 1.2, 0.0);
    const Rgb seen = draw(picture, view, 200, 160).at(100, 60);
    EXPECT_GT(seen.r, 100) << height;
    EXPECT_LT(seen.g, 40) << height;
  }
  // A sheet that is cut leaves no section: nothing of it holds a point.
  View cut;
  cut.cut_z_m = 0.5;
  picture.surfaces[0].polygon.vertices[0].z() = 1.0;
  const Image image = draw(picture, cut, 200, 160);
  for (int y = 0; y < 160; y += 4) {
    for (int x = 0; x < 200; x += 4) EXPECT_NE(image.at(x, y), palette::kCut);
  }
}

}  // namespace
}  // namespace hallway::render
