// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/data.hpp"
#include "support/process.hpp"
#include "unit/mesh/gltf_text.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;

TEST(Import, MapRendersAtOnce) {
  const TempFolder folder;
  folder.write("model.gltf", triangle_gltf().dump());
  const std::string map = folder / "model.map";
  const Ended ended = hallway({"import", folder / "model.gltf", "--out", map});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("1 triangles"), std::string::npos) << ended.out;
  EXPECT_NE(read_file(map).find("\"model\" \"model.gltf\""), std::string::npos);
  EXPECT_EQ(hallway({"render", map, "--strict", "--out", folder / "a.png", "--size", "64x64"}).status, 0);
  // The same map again, byte for byte, and not without being told to replace the first.
  const std::string text = read_file(map);
  EXPECT_EQ(hallway({"import", folder / "model.gltf", "--out", map}).status, 3);
  EXPECT_EQ(hallway({"import", folder / "model.gltf", "--out", map, "--force"}).status, 0);
  EXPECT_EQ(read_file(map), text);
}

TEST(Import, ModelElsewhereNeedsACopy) {
  const TempFolder from;
  const TempFolder to;
  from.write("model.gltf", triangle_gltf().dump());
  const Ended refused = hallway({"import", from / "model.gltf", "--out", to / "a.map"});
  EXPECT_EQ(refused.status, 3);
  EXPECT_NE(refused.err.find("--copy"), std::string::npos) << refused.err;
  EXPECT_TRUE(fs::is_empty(to.path()));
  const Ended ended = hallway({"import", from / "model.gltf", "--out", to / "a.map", "--copy", "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const auto report = nlohmann::ordered_json::parse(ended.out);
  EXPECT_EQ(report.at("schema"), "hallway.import/1");
  EXPECT_EQ(report.at("triangles"), 1);
  EXPECT_EQ(report.at("model"), "model.gltf");
  EXPECT_EQ(read_file(to / "model.gltf"), triangle_gltf().dump());
}

TEST(Import, FailuresAreDocumentsToo) {
  const TempFolder folder;
  folder.write("bad.glb", "glTF");
  const Ended ended = hallway({"import", folder / "bad.glb", "--out", folder / "a.map", "--json"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_NE(nlohmann::ordered_json::parse(ended.out).dump().find("bad.glb"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "a.map"));
  EXPECT_EQ(hallway({"import", folder / "bad.glb"}).status, 2);
  EXPECT_EQ(hallway({"import", folder / "bad.glb", "--out", folder / "a.map", "--units", "-1"}).status, 2);
  EXPECT_EQ(hallway({"import", folder / "bad.glb", "--out", folder / "a.map", "--root", "x"}).status, 2);
  EXPECT_EQ(hallway({"import", folder / "none.glb", "--out", folder / "a.map"}).status, 3);
}

TEST(Import, BuildingWithTheTexturesBesideIt) {
  HALLWAY_DATA_OR_SKIP(building, "models/buildings/willowgarage");
  const TempFolder folder;
  const Ended ended = hallway({"import", building / "meshes/willowgarage_visual.dae", "--out",
                               folder / "garage.map", "--copy", "--root", building, "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(nlohmann::ordered_json::parse(ended.out).at("images"), 7);
  EXPECT_TRUE(fs::exists(folder / "meshes/willowgarage_visual.dae"));
  EXPECT_TRUE(fs::exists(folder / "materials/textures/Wood_Cherry_Original_.png"));
}

}  // namespace
}  // namespace hallway::test
