// SPDX-License-Identifier: MIT
#include "mesh/import.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "map/entities.hpp"
#include "map/reader.hpp"
#include "map/world.hpp"
#include "map/writer.hpp"
#include "mesh/placement.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/mesh/models.hpp"

namespace hallway::mesh {
namespace {

namespace fs = std::filesystem;

ImportOptions options_for(const std::string& model) {
  ImportOptions options;
  options.model = model;
  return options;
}

/// Whether a point is in one of the solids.
bool is_solid(const map::World& world, const Vec3& point) {
  for (const map::Solid& solid : world.solids) {
    if (solid.contains(point, -1e-9)) return true;
  }
  return false;
}

TEST(Import, HullIsClosedAroundTheModel) {
  const Model model = test::random_model(5, 200);
  const map::Document document =
      map::parse(map::print(import_document(model, options_for("a.glb"))), "a.map");
  const map::World world = map::build_world(document);
  EXPECT_TRUE(world.problems.empty());
  ASSERT_EQ(world.solids.size(), 6u);
  const Box bounds = bounds_of(model);
  for (const Vec3& vertex : model.vertices) EXPECT_FALSE(is_solid(world, vertex));
  // Every way out along a dense set of directions ends in a solid.
  const Vec3 centre = bounds.center();
  for (int i = 0; i < 2000; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / 2000.0;
    const double turn = 2.399963229728653 * i;
    const double r = std::sqrt(1.0 - z * z);
    const Vec3 direction(r * std::cos(turn), r * std::sin(turn), z);
    bool stopped = false;
    for (double way = 0.0; way < 120.0 && !stopped; way += 0.05)
      stopped = is_solid(world, centre + way * direction);
    EXPECT_TRUE(stopped) << direction.transpose();
  }
}

TEST(Import, RobotStandsInTheFreeStrip) {
  const Model model = test::random_model(6, 200);
  const map::Document document = import_document(model, options_for("a.glb"));
  const auto start = map::find_robot_start(document);
  ASSERT_TRUE(start.has_value());
  EXPECT_LT(start->T_world_body.t.x(), bounds_of(model).min().x() - 0.5);
  EXPECT_FALSE(is_solid(map::build_world(document), start->T_world_body.t));
}

TEST(Import, ModelIsPlacedWithItsUnits) {
  Model model = test::cube();
  model.metres_per_unit = 0.5;
  ImportOptions options = options_for("models/a b.glb");
  options.units = 2.0;
  const map::Document document = map::parse(map::print(import_document(model, options)), "a.map");
  EXPECT_EQ(document.metres_per_unit(), 0.01);
  const std::vector<Placement> found = placements(document);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].model, "models/a b.glb");
  const PlacedMesh mesh = place(model, found[0]);
  const map::World world = map::build_world(document);
  for (const Vec3& vertex : mesh.vertices) {
    EXPECT_NEAR(vertex.cwiseAbs().maxCoeff(), 2.0, 1e-9);
    EXPECT_FALSE(is_solid(world, vertex));
  }
}

TEST(Import, ModelTooLargeForAMapIsRefused) {
  Model model = test::cube();
  for (Vec3& vertex : model.vertices) vertex *= 1e7;
  const auto error = test::error_of([&] { import_document(model, options_for("a.glb")); });
  ASSERT_TRUE(error.has_value());
  EXPECT_NE(std::string(error->what()).find("--units"), std::string::npos);
}

TEST(Import, PathInTheFolderOfTheMap) {
  const test::TempFolder folder;
  fs::create_directories(folder / "maps/models");
  folder.write("maps/models/a.glb", "x");
  folder.write("b.glb", "x");
  fs::create_symlink("../b.glb", folder / "maps/link.glb");
  EXPECT_EQ(path_in_map_folder(folder / "maps/models/a.glb", folder / "maps"), "models/a.glb");
  EXPECT_EQ(path_in_map_folder(folder / "maps/models/../models/a.glb", folder / "maps"), "models/a.glb");
  for (const char* outside : {"b.glb", "maps/link.glb"}) {
    const auto error = test::error_of([&] { path_in_map_folder(folder / outside, folder / "maps"); });
    ASSERT_TRUE(error.has_value()) << outside;
    EXPECT_NE(std::string(error->what()).find("--copy"), std::string::npos);
  }
  EXPECT_EQ(test::error_of([&] { path_in_map_folder(folder / "no.glb", folder / "maps"); })->code(),
            ErrorCode::kIo);
}

TEST(Import, CopiesKeepTheirPathsAndReplaceNothing) {
  const test::TempFolder from;
  const test::TempFolder to;
  fs::create_directory(from / "textures");
  from.write("a.gltf", "model");
  from.write("textures/a.png", "picture");
  const std::vector<std::string> files{"a.gltf", "textures/a.png"};
  copy_model_files(files, from.path(), to.path(), false);
  EXPECT_EQ(read_file(to / "textures/a.png"), "picture");
  copy_model_files(files, from.path(), to.path(), false);  // the same content again
  to.write("textures/a.png", "another");
  from.write("a.gltf", "newer");
  EXPECT_TRUE(test::error_of([&] { copy_model_files(files, from.path(), to.path(), false); }).has_value());
  EXPECT_EQ(read_file(to / "a.gltf"), "model");
  EXPECT_EQ(read_file(to / "textures/a.png"), "another");
  copy_model_files(files, from.path(), to.path(), true);
  EXPECT_EQ(read_file(to / "a.gltf"), "newer");
  EXPECT_EQ(read_file(to / "textures/a.png"), "picture");
}

}  // namespace
}  // namespace hallway::mesh
