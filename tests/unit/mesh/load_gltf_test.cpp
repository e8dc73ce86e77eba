// SPDX-License-Identifier: MIT
// What a good glTF file means, through the helper program.
#include <gtest/gtest.h>

#include "mesh/load.hpp"
#include "support/temp_folder.hpp"
#include "unit/mesh/gltf_text.hpp"

namespace hallway::mesh {
namespace {

using test::Json;

Model load_json(const Json& json) {
  const test::TempFolder folder;
  return load_model(folder.write("model.gltf", json.dump()), folder.path());
}

void expect_near(const Vec3& a, const Vec3& b) {
  EXPECT_LT((a - b).norm(), 1e-6) << a.transpose() << " is not " << b.transpose();
}

TEST(LoadGltf, YUpBecomesZUp) {
  const Model model = load_json(test::triangle_gltf());
  ASSERT_EQ(model.triangles.size(), 1u);
  expect_near(model.vertices.at(0), {0, 0, 0});
  expect_near(model.vertices.at(1), {1, 0, 0});
  expect_near(model.vertices.at(2), {0, 0, 1});
  EXPECT_EQ(model.metres_per_unit, 1.0);
  EXPECT_EQ(model.files, std::vector<std::string>{"model.gltf"});
  EXPECT_TRUE(model.warnings.empty());
}

TEST(LoadGltf, BinaryFileIsTheSame) {
  const test::TempFolder folder;
  const Model text = load_json(test::triangle_gltf());
  const Model binary = load_model(folder.write("model.glb", test::triangle_glb()), folder.path());
  EXPECT_EQ(binary.vertices, text.vertices);
  EXPECT_EQ(binary.triangles.at(0).vertices, text.triangles.at(0).vertices);
}

TEST(LoadGltf, NodeTransformsAreAppliedFromTheRootDown) {
  Json json = test::triangle_gltf();
  json["nodes"] = Json::parse(R"([{"children": [1], "translation": [10, 0, 0]},
      {"mesh": 0, "scale": [2, 2, 2], "rotation": [0, 0.7071067811865476, 0, 0.7071067811865476]}])");
  const Model model = load_json(json);
  // A quarter turn about the file's y leads x to -z, which is our +y.
  expect_near(model.vertices.at(1), {10, 2, 0});
  expect_near(model.vertices.at(2), {10, 0, 2});
}

TEST(LoadGltf, MatrixStandsByColumns) {
  Json json = test::triangle_gltf();
  json["nodes"] = Json::parse(R"([{"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1]}])");
  expect_near(load_json(json).vertices.at(0), {5, -7, 6});
}

TEST(LoadGltf, MirroredNodeKeepsItsFrontInFront) {
  Json json = test::triangle_gltf();
  json["nodes"] = Json::parse(R"([{"mesh": 0, "scale": [-1, 1, 1]}])");
  const Model model = load_json(json);
  const auto& [a, b, c] = model.triangles.at(0).vertices;
  const Vec3 normal = (model.vertices[b] - model.vertices[a]).cross(model.vertices[c] - model.vertices[a]);
  // The file's +z, towards the viewer of the unmirrored triangle, is our -y.
  EXPECT_LT(normal.y(), 0.0);
}

TEST(LoadGltf, MeshOfTwoNodesIsThereTwice) {
  Json json = test::triangle_gltf();
  json["nodes"] = Json::parse(R"([{"mesh": 0}, {"mesh": 0, "translation": [3, 0, 0]}])");
  json["scenes"][0]["nodes"] = {0, 1};
  const Model model = load_json(json);
  ASSERT_EQ(model.triangles.size(), 2u);
  expect_near(model.vertices.at(model.triangles[1].vertices[0]), {3, 0, 0});
}

TEST(LoadGltf, StripsAndFans) {
  Json json = test::triangle_gltf();
  json["buffers"][0]["uri"] =
      test::data_uri(test::bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}));
  json["buffers"][0]["byteLength"] = 48;
  json["bufferViews"] = Json::parse(R"([{"buffer": 0, "byteLength": 48}])");
  json["accessors"] =
      Json::parse(R"([{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}])");
  json["meshes"][0]["primitives"][0] = Json::parse(R"({"attributes": {"POSITION": 0}, "mode": 5})");
  const Model strip = load_json(json);
  ASSERT_EQ(strip.triangles.size(), 2u);
  EXPECT_EQ(strip.triangles[0].vertices, (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(strip.triangles[1].vertices, (std::array<std::uint32_t, 3>{1, 3, 2}));
  json["meshes"][0]["primitives"][0]["mode"] = 6;
  const Model fan = load_json(json);
  ASSERT_EQ(fan.triangles.size(), 2u);
  EXPECT_EQ(fan.triangles[1].vertices, (std::array<std::uint32_t, 3>{2, 3, 0}));
}

TEST(LoadGltf, SparseValuesReplaceOthers) {
  Json json = test::triangle_gltf();
  const std::string more =
      test::bytes_of(std::vector<std::uint32_t>{1}) + test::bytes_of(std::vector<float>{7, 8, 9});
  json["buffers"].push_back({{"byteLength", more.size()}, {"uri", test::data_uri(more)}});
  json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 4}});
  json["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", 4}, {"byteLength", 12}});
  json["accessors"][0]["sparse"] = Json::parse(
      R"({"count": 1, "indices": {"bufferView": 2, "componentType": 5125}, "values": {"bufferView": 3}})");
  const Model model = load_json(json);
  expect_near(model.vertices.at(0), {0, 0, 0});
  expect_near(model.vertices.at(1), {7, -9, 8});
}

TEST(LoadGltf, MaterialsAndTextures) {
  // A picture of 2 x 1 pixels, red and blue: BMP, 24 bits.
  std::string bmp("BM\x3e\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\1\0\0\0\1\0\x18\0", 30);
  bmp += std::string(24, '\0') + std::string("\0\0\xff\xff\0\0\0\0", 8);
  const test::TempFolder folder;
  folder.write("a picture.bmp", bmp);
  Json json = test::triangle_gltf();
  json["materials"] = Json::parse(R"([{"name": "plain"}, {"name": "tiles", "pbrMetallicRoughness":
      {"baseColorFactor": [0.5, 0.25, 0, 1], "baseColorTexture": {"index": 0}}}])");
  json["textures"] = Json::parse(R"([{"source": 0}])");
  json["images"] = Json::parse(R"([{"uri": "a%20picture.bmp"}])");
  json["accessors"].push_back(
      Json::parse(R"({"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC2"})"));
  const std::string uv = test::bytes_of(std::vector<float>{0, 0, 1, 0, 0.5, 2});
  json["buffers"].push_back({{"byteLength", uv.size()}, {"uri", test::data_uri(uv)}});
  json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", uv.size()}});
  json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 2;
  json["meshes"][0]["primitives"][0]["material"] = 1;
  const Model model = load_model(folder.write("model.gltf", json.dump()), folder.path());
  EXPECT_TRUE(model.warnings.empty()) << model.warnings.front();
  ASSERT_EQ(model.materials.size(), 2u);
  const Material& material = model.materials.at(model.triangles.at(0).material);
  EXPECT_EQ(material.name, "tiles");
  EXPECT_EQ(material.base_colour, (std::array<float, 4>{0.5F, 0.25F, 0.0F, 1.0F}));
  ASSERT_TRUE(material.image.has_value());
  const Image& image = model.images.at(*material.image);
  EXPECT_EQ(image.width, 2u);
  EXPECT_EQ(image.height, 1u);
  EXPECT_EQ(image.rgba, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 0, 255, 255}));
  ASSERT_EQ(model.uv.size(), 3u);
  EXPECT_EQ(model.uv[2], (std::array<float, 2>{0.5F, 2.0F}));
  EXPECT_EQ(model.files, (std::vector<std::string>{"a picture.bmp", "model.gltf"}));
}

TEST(LoadGltf, AlphaOfAnOpaqueMaterialSaysNothing) {
  // A picture of 1 x 1 pixel, half transparent: TGA, 32 bits.
  const std::string tga = std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x20\x28", 18) + "\x1e\x14\x0a\x40";
  const test::TempFolder folder;
  folder.write("a.tga", tga);
  Json json = test::triangle_gltf();
  json["materials"] = Json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
      {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "alphaMode": "MASK"},
      {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "alphaMode": "BLEND"}])");
  json["textures"] = Json::parse(R"([{"source": 0}])");
  json["images"] = Json::parse(R"([{"uri": "a.tga"}])");
  const Model model = load_model(folder.write("model.gltf", json.dump()), folder.path());
  ASSERT_EQ(model.images.size(), 2u);
  const auto pixel = [&](std::size_t material) {
    return model.images.at(model.materials.at(material).image.value()).rgba;
  };
  EXPECT_EQ(pixel(0), (std::vector<std::uint8_t>{10, 20, 30, 255}));
  EXPECT_EQ(pixel(1), (std::vector<std::uint8_t>{10, 20, 30, 64}));
  EXPECT_EQ(model.materials[1].image, model.materials[2].image);
}

TEST(LoadGltf, SameBytesEachTime) {
  const Json json = test::triangle_gltf();
  const Model first = load_json(json);
  const Model second = load_json(json);
  EXPECT_EQ(first.vertices, second.vertices);
}

}  // namespace
}  // namespace hallway::mesh
