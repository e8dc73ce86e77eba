// SPDX-License-Identifier: MIT
#include "mesh/placement.hpp"

#include <gtest/gtest.h>

#include "map/reader.hpp"
#include "support/errors.hpp"
#include "unit/mesh/models.hpp"

namespace hallway::mesh {
namespace {

map::Document document_with(const std::string& keys) {
  return map::parse(
      "{\n\"classname\" \"worldspawn\"\n\"_scale\" \"0.01\"\n}\n{\n\"classname\" \"hw_mesh\"\n" + keys +
          "}\n",
      "test.map");
}

Placement placement_with(const std::string& keys) {
  return placements(document_with("\"model\" \"a.glb\"\n\"origin\" \"100 200 300\"\n" + keys)).at(0);
}

void expect_near(const Vec3& a, const Vec3& b) {
  EXPECT_LT((a - b).norm(), 1e-9) << a.transpose() << " is not " << b.transpose();
}

TEST(Placement, DefaultsAreTheModelAsItIs) {
  const Placement placement = placement_with("");
  EXPECT_EQ(placement.model, "a.glb");
  EXPECT_EQ(placement.entity, 1);
  EXPECT_EQ(placement.line, 5);
  const Model model = test::cube();
  const PlacedMesh mesh = place(model, placement);
  ASSERT_EQ(mesh.triangles.size(), 12u);
  for (std::size_t i = 0; i < model.vertices.size(); ++i) {
    expect_near(mesh.vertices[i], model.vertices[i] + Vec3(1, 2, 3));
  }
}

TEST(Placement, AnglesTurnByYawThenPitchThenRoll) {
  const Model model = test::cube();
  const auto turned = [&](const std::string& keys, const Vec3& point) {
    return Vec3(model_to_world(model, placement_with(keys)) * point - Vec3(1, 2, 3));
  };
  expect_near(turned("\"angles\" \"0 90 0\"\n", {1, 0, 0}), {0, 1, 0});
  expect_near(turned("\"angle\" \"90\"\n", {1, 0, 0}), {0, 1, 0});
  expect_near(turned("\"angles\" \"90 0 0\"\n", {1, 0, 0}), {0, 0, -1});
  expect_near(turned("\"angles\" \"0 0 90\"\n", {0, 1, 0}), {0, 0, 1});
  expect_near(turned("\"angles\" \"0 90 90\"\n", {0, 1, 0}), {0, 0, 1});
}

TEST(Placement, ScaleIsAlongTheModelsAxes) {
  const Model model = test::cube();
  const auto placed = [&](const std::string& keys, const Vec3& point) {
    return Vec3(model_to_world(model, placement_with(keys)) * point - Vec3(1, 2, 3));
  };
  expect_near(placed("\"scale\" \"2\"\n", {1, 1, 1}), {2, 2, 2});
  expect_near(placed("\"scale\" \"2 3 4\"\n\"angle\" \"90\"\n", {1, 0, 0}), {0, 2, 0});
}

TEST(Placement, UnitsReplaceWhatTheFileSays) {
  Model model = test::cube();
  model.metres_per_unit = 0.0254;
  const Eigen::Affine3d transform = model_to_world(model, placement_with("\"units\" \"0.01\"\n"));
  expect_near(transform.linear() * Vec3(0.0254, 0, 0), {0.01, 0, 0});
}

TEST(Placement, MirroringKeepsTheFrontInFront) {
  const Model model = test::cube();
  const PlacedMesh mesh = place(model, placement_with("\"scale\" \"-1 1 1\"\n"));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = mesh.corners(i);
    EXPECT_GT((b - a).cross(c - a).dot(a - Vec3(1, 2, 3)), 0.0) << i;
  }
}

TEST(Placement, BadKeysAreNamedWithTheirLine) {
  for (const char* keys :
       {"\"angles\" \"0 90\"\n", "\"angles\" \"a b c\"\n", "\"scale\" \"0\"\n", "\"scale\" \"1 2\"\n",
        "\"scale\" \"1 2 nan\"\n", "\"units\" \"-1\"\n", "\"units\" \"inch\"\n", "\"modle\" \"x\"\n",
        "\"angles\" \"0 0 0\"\n\"angle\" \"0\"\n"}) {
    const auto error = test::error_of([&] { placement_with(keys); });
    ASSERT_TRUE(error.has_value()) << keys;
    EXPECT_EQ(error->where().file, "test.map");
    EXPECT_GE(error->where().line, 5) << keys;
  }
  EXPECT_TRUE(test::error_of([] { placements(document_with("\"origin\" \"0 0 0\"\n")); }).has_value());
  EXPECT_TRUE(test::error_of([] { placements(document_with("\"model\" \"a.glb\"\n")); }).has_value());
}

TEST(Placement, ModelPathIsInTheFolderOfTheMap) {
  Placement placement;
  placement.model = "models/a.glb";
  EXPECT_EQ(model_path(placement, "maps"), "maps/models/a.glb");
  for (const char* name : {"/etc/passwd", "file:///etc/passwd", "http://x/y.glb"}) {
    placement.model = name;
    EXPECT_TRUE(test::error_of([&] { model_path(placement, "maps"); }).has_value()) << name;
  }
}

}  // namespace
}  // namespace hallway::mesh
