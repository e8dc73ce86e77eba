// SPDX-License-Identifier: MIT
// Files made to break the reader: each is a message that names file and cause, in bounded time and memory.
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <filesystem>
#include <functional>

#include "mesh/load.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/mesh/gltf_text.hpp"

namespace hallway::mesh {
namespace {

namespace fs = std::filesystem;
using test::Json;

/// Loads what `change` makes of a good file; expects an Error that names the file and contains `cause`.
void expect_refused(const std::function<void(Json&)>& change, const std::string& cause) {
  const test::TempFolder folder;
  Json json = test::triangle_gltf();
  change(json);
  const fs::path file = folder.write("bad.gltf", json.dump());
  const auto error = test::error_of([&] { load_model(file, folder.path()); });
  ASSERT_TRUE(error.has_value()) << cause;
  EXPECT_NE(std::string(error->what()).find(cause), std::string::npos) << error->what();
  EXPECT_EQ(error->where().file, file.string());
}

std::string error_text(const fs::path& file, const fs::path& root) {
  const auto error = test::error_of([&] { load_model(file, root); });
  return error ? error->what() : "";
}

TEST(HostileGltf, HugeAccessorCount) {
  expect_refused([](Json& json) { json["accessors"][0]["count"] = std::uint64_t{1} << 62; }, "accessor 0");
  expect_refused([](Json& json) { json["accessors"][1]["count"] = std::uint64_t{1} << 62; }, "accessor 1");
  expect_refused([](Json& json) { json["accessors"][0]["count"] = 29'000'000; }, "reach beyond");
}

TEST(HostileGltf, HugeAccessorCountWithoutBytes) {
  expect_refused(
      [](Json& json) {
        json["accessors"][0].erase("bufferView");
        json["accessors"][0]["count"] = std::uint64_t{1} << 62;
      },
      "over the limit of vertices");
}

TEST(HostileGltf, ManyLargeAccessorsWithoutBytes) {
  expect_refused(
      [](Json& json) {
        json["accessors"][0].erase("bufferView");
        json["accessors"][0]["count"] = 20'000'000;
        json["meshes"][0]["primitives"].push_back(json["meshes"][0]["primitives"][0]);
      },
      "over the limit of vertices");
}

TEST(HostileGltf, OffsetsNearTwoToThe64) {
  for (const std::uint64_t offset : {~std::uint64_t{0}, ~std::uint64_t{0} - 35, std::uint64_t{1} << 63}) {
    expect_refused([&](Json& json) { json["accessors"][0]["byteOffset"] = offset; }, "accessor 0");
    expect_refused([&](Json& json) { json["bufferViews"][0]["byteOffset"] = offset; }, "bad.gltf");
    expect_refused([&](Json& json) { json["bufferViews"][0]["byteLength"] = offset; }, "bad.gltf");
  }
}

TEST(HostileGltf, Strides) {
  expect_refused([](Json& json) { json["bufferViews"][0]["byteStride"] = 4; }, "stride 4 is less");
  expect_refused([](Json& json) { json["bufferViews"][0]["byteStride"] = 252; }, "reach beyond");
  expect_refused([](Json& json) { json["bufferViews"][0]["byteStride"] = ~std::uint64_t{0}; }, "bad.gltf");
  // A stride of 0 is the same as none.
  const test::TempFolder folder;
  Json json = test::triangle_gltf();
  json["bufferViews"][0]["byteStride"] = 0;
  EXPECT_EQ(load_model(folder.write("a.gltf", json.dump()), folder.path()).triangles.size(), 1u);
}

TEST(HostileGltf, IndexBeyondItsVertices) {
  expect_refused(
      [](Json& json) {
        json["buffers"][0]["uri"] = test::data_uri(test::bytes_of(std::vector<float>(9)) +
                                                   test::bytes_of(std::vector<std::uint16_t>{0, 1, 3, 0}));
      },
      "names vertex 3 of 3");
}

TEST(HostileGltf, NodesThatFormNoTree) {
  expect_refused([](Json& json) { json["nodes"] = Json::parse(R"([{"children": [0], "mesh": 0}])"); },
                 "reached twice");
  expect_refused(
      [](Json& json) {
        json["nodes"] = Json::parse(R"([{"children": [1]}, {"children": [2]}, {"children": [1]}])");
      },
      "reached twice");
  expect_refused([](Json& json) { json["nodes"] = Json::parse(R"([{"children": [7]}])"); },
                 "there is no node 7");
  expect_refused([](Json& json) { json["scenes"][0]["nodes"] = {0, 0}; }, "reached twice");
}

TEST(HostileGltf, ChainOfAHundredThousandNodesIsRead) {
  const test::TempFolder folder;
  Json json = test::triangle_gltf();
  json["nodes"] = Json::array();
  constexpr int kNodes = 100'000;
  for (int i = 0; i + 1 < kNodes; ++i) json["nodes"].push_back({{"children", {i + 1}}});
  json["nodes"].push_back({{"mesh", 0}});
  EXPECT_EQ(load_model(folder.write("deep.gltf", json.dump()), folder.path()).triangles.size(), 1u);
}

TEST(HostileGltf, NumbersThatAreNone) {
  expect_refused(
      [](Json& json) {
        json["nodes"][0]["translation"] = {1e300, 1e300, 1e300};
      },
      "not finite or beyond");
  expect_refused([](Json& json) { json["nodes"][0]["scale"] = {1e308, 1e308, 1e308}; }, "");
  expect_refused(
      [](Json& json) {
        json["nodes"] = Json::parse(R"([{"children": [1], "scale": [1e200, 1e200, 1e200]},
                                        {"mesh": 0, "scale": [1e200, 1e200, 1e200]}])");
      },
      "not finite");
  expect_refused([](Json& json) { json["nodes"][0]["rotation"] = {0, 0, 0, 0}; }, "no quaternion");
  expect_refused(
      [](Json& json) {
        std::vector<float> positions(9, std::numeric_limits<float>::quiet_NaN());
        json["buffers"][0]["uri"] = test::data_uri(test::bytes_of(positions) +
                                                   test::bytes_of(std::vector<std::uint16_t>{0, 1, 2, 0}));
      },
      "not finite");
  // What is no JSON number at all: NaN, 1e400.
  const test::TempFolder folder;
  for (const char* number : {"NaN", "Infinity", "1e400"}) {
    std::string text = test::triangle_gltf().dump();
    text.replace(text.find("\"mesh\":0"), 8, "\"mesh\":0,\"translation\":[" + std::string(number) + ",0,0]");
    EXPECT_NE(error_text(folder.write("bad.gltf", text), folder.path()), "") << number;
  }
}

TEST(HostileGltf, LengthsOfABinaryFileThatLie) {
  const test::TempFolder folder;
  const std::string good = test::triangle_glb();
  const auto with = [&](std::size_t at, std::uint32_t value) {
    std::string bytes = good;
    std::memcpy(bytes.data() + at, &value, sizeof value);
    return error_text(folder.write("bad.glb", bytes), folder.path());
  };
  EXPECT_NE(with(8, 0xFFFFFFFFU).find("says that it has 4294967295 bytes"), std::string::npos);
  EXPECT_NE(with(8, 0).find("says that it has 0 bytes"), std::string::npos);
  EXPECT_NE(with(12, 0xFFFFFFFCU).find("reaches beyond the end"), std::string::npos);
  EXPECT_NE(with(4, 1).find("version 1"), std::string::npos);
  for (std::size_t size = 0; size < good.size(); size += size < 40 ? 1 : 97) {
    EXPECT_NE(error_text(folder.write("cut.glb", good.substr(0, size)), folder.path()), "") << size;
  }
}

TEST(HostileGltf, NestedJson) {
  const test::TempFolder folder;
  const std::string deep = "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(1'000'000, '[') + "}";
  EXPECT_NE(error_text(folder.write("deep.gltf", deep), folder.path()).find("nested deeper"),
            std::string::npos);
}

TEST(HostileGltf, Base64OfAGigabyteIsOverTheLimit) {
  const test::TempFolder folder;
  LoadLimits limits;
  limits.model.file_bytes = 1'000'000;  // the rule is the same at a size that a test can write
  Json json = test::triangle_gltf();
  json["extras"] = std::string(2'000'000, 'A');
  const fs::path file = folder.write("large.gltf", json.dump());
  const auto error = test::error_of([&] { load_model(file, folder.path(), limits); });
  ASSERT_TRUE(error.has_value());
  EXPECT_NE(std::string(error->what()).find("at most 1000000 are read"), std::string::npos) << error->what();
}

TEST(HostileGltf, MemoryLimitIsAMessage) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer's address space cannot be limited";
#endif
  const test::TempFolder folder;
  LoadLimits limits;
  limits.child.memory_bytes = std::uint64_t{300} << 20;
  Json json = test::triangle_gltf();
  json["accessors"][0].erase("bufferView");
  json["accessors"][0]["count"] = 29'999'999;
  const fs::path file = folder.write("large.gltf", json.dump());
  const auto error = test::error_of([&] { load_model(file, folder.path(), limits); });
  ASSERT_TRUE(error.has_value());
  EXPECT_NE(std::string(error->what()).find("memory"), std::string::npos) << error->what();
}

/// A secret beside the folder that may be read, and ways to it.
class OutsideTest : public testing::Test {
 protected:
  OutsideTest() {
    fs::create_directory(outer_ / "maps");
    outer_.write("secret.bin", test::triangle_bytes());
    outer_.write("maps/inside.bin", test::triangle_bytes());
    fs::create_symlink("../secret.bin", outer_ / "maps/link.bin");
    fs::create_symlink("..", outer_ / "maps/folder");
    fs::create_symlink("inside.bin", outer_ / "maps/good_link.bin");
  }

  std::string load_with(const std::string& key, const std::string& uri) {
    Json json = test::triangle_gltf();
    if (key == "buffers") {
      json["buffers"][0]["uri"] = uri;
    } else {
      json["images"] = {{{"uri", uri}}};
    }
    return error_text(outer_.write("maps/model.gltf", json.dump()), outer_ / "maps");
  }

  test::TempFolder outer_;
};

TEST_F(OutsideTest, FilesOutsideTheFolderAreNeverOpened) {
  const std::string absolute = (outer_ / "secret.bin").string();
  for (const std::string& uri :
       {std::string("../secret.bin"), std::string("%2e%2e/secret.bin"), std::string("%2E%2E%2Fsecret.bin"),
        std::string("./../secret.bin"), std::string("x/../../secret.bin"), std::string("link.bin"),
        std::string("folder/secret.bin"), absolute, "file://" + absolute, "FILE:" + absolute,
        std::string("http://localhost/secret.bin"), std::string("%66ile:secret.bin"),
        std::string("/etc/passwd"), std::string("/dev/zero")}) {
    for (const char* key : {"buffers", "images"}) {
      const std::string error = load_with(key, uri);
      EXPECT_NE(error.find("refused"), std::string::npos) << key << " " << uri << ": " << error;
    }
  }
}

TEST_F(OutsideTest, FilesInsideAreOpened) {
  EXPECT_EQ(load_with("buffers", "inside.bin"), "");
  EXPECT_EQ(load_with("buffers", "./inside.bin"), "");
  EXPECT_EQ(load_with("buffers", "good_link.bin"), "");
  EXPECT_EQ(load_with("buffers", "../maps/inside.bin"), "");
}

TEST_F(OutsideTest, ModelOutsideTheFolder) {
  const fs::path model = outer_.write("model.gltf", test::triangle_gltf().dump());
  EXPECT_NE(error_text(model, outer_ / "maps").find("outside the folder"), std::string::npos);
  EXPECT_NE(error_text(outer_ / "maps/../model.gltf", outer_ / "maps").find("outside the folder"),
            std::string::npos);
}

TEST_F(OutsideTest, OtherFormats) {
  outer_.write("secret.mtl", "newmtl a\nKd 0.25 0.5 0.75\n");
  const std::string body = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";
  for (const std::string& name :
       {std::string("../secret.mtl"), (outer_ / "secret.mtl").string(), std::string("folder/secret.mtl")}) {
    const fs::path file = outer_.write("maps/model.obj", "mtllib " + name + "\n" + body);
    const Model model = load_model(file, outer_ / "maps");
    EXPECT_EQ(model.triangles.size(), 1u);
    EXPECT_EQ(model.files, std::vector<std::string>{"model.obj"}) << name;
    for (const Material& material : model.materials) EXPECT_NE(material.base_colour[2], 0.75F) << name;
  }
}

TEST(HostileGltf, ImagesThatAreBombs) {
  // Headers alone: PNG, BMP, TGA and JPEG of 60 000 x 60 000 pixels.
  const std::string side("\0\0\xea\x60", 4);
  const std::string png = std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16) + side + side +
                          std::string("\x08\x06\0\0\0\0\0\0\0", 9) +
                          std::string("\0\0\0\x01IDAT\0\0\0\0\0", 13);
  const std::string bmp =
      std::string("BM\x3e\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x60\xea\0\0\x60\xea\0\0\1\0\x18\0", 30) +
      std::string(32, '\0');
  const std::string tga =
      std::string("\0\0\x02\0\0\0\0\0\0\0\0\0\x60\xea\x60\xea\x20\x08", 18) + std::string(64, '\0');
  const std::string jpeg =
      std::string("\xff\xd8\xff\xc0\0\x11\x08\xea\x60\xea\x60\3\1\x22\0\2\x11\1\3\x11\1", 21) +
      std::string(64, '\0');
  for (const std::string& image : {png, bmp, tga, jpeg}) {
    expect_refused(
        [&](Json& json) {
          json["images"] = {{{"uri", "data:image/png;base64," + test::base64(image)}}};
          json["textures"] = Json::parse(R"([{"source": 0}])");
          json["materials"] =
              Json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
        },
        "60000 x 60000 pixels");
  }
}

/// More symbols than there are overrun the decoder's table.
TEST(HostileGltf, AJpegWithTooManyHuffmanSymbolsIsNotDecoded) {
  const test::TempFolder folder;
  for (const std::string& before : {std::string("\xff\xd8", 2), std::string("\xff\xff\xff\xd8", 4)}) {
    const std::string jpeg =
        before + std::string("\xff\xc4\x0f\xff\0", 5) + std::string(16, '\xff') + std::string(4096, '\1');
    Json json = test::triangle_gltf();
    json["images"] = {{{"uri", "data:image/jpeg;base64," + test::base64(jpeg)}}};
    json["textures"] = Json::parse(R"([{"source": 0}])");
    json["materials"] = Json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
    const Model model = load_model(folder.write("model.gltf", json.dump()), folder.path());
    EXPECT_EQ(model.triangles.size(), 1u);
    ASSERT_EQ(model.warnings.size(), 1u);
    EXPECT_NE(model.warnings[0].find("Huffman"), std::string::npos) << model.warnings[0];
  }
}

TEST(HostileGltf, ImageThatIsMissingOrBrokenLeavesTheRest) {
  const test::TempFolder folder;
  folder.write("broken.png", "no picture");
  Json json = test::triangle_gltf();
  json["images"] = Json::parse(
      R"([{"uri": "missing.png"}, {"uri": "broken.png"}, {"bufferView": 0, "mimeType": "image/png"}])");
  json["textures"] = Json::parse(R"([{"source": 0}, {"source": 1}, {"source": 2}])");
  json["materials"] = Json::array();
  for (int i = 0; i < 3; ++i)
    json["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
  const Model model = load_model(folder.write("model.gltf", json.dump()), folder.path());
  EXPECT_EQ(model.triangles.size(), 1u);
  EXPECT_TRUE(model.images.empty());
  EXPECT_EQ(model.warnings.size(), 3u);
}

TEST(HostileFile, ThingsThatAreNoModel) {
  const test::TempFolder folder;
  for (const char* extension : {"gltf", "glb", "obj", "stl", "ply", "dae", "fbx", "3ds", "unknown"}) {
    const std::string name = std::string("model.") + extension;
    for (const std::string& content : {std::string(), std::string("x"), std::string(4096, '\0')}) {
      EXPECT_NE(error_text(folder.write(name, content), folder.path()), "")
          << name << " of " << content.size();
    }
    fs::remove(folder / name);
    EXPECT_NE(error_text(folder / name, folder.path()).find("No such file"), std::string::npos) << name;
    fs::create_directory(folder / name);
    EXPECT_NE(error_text(folder / name, folder.path()).find("is a folder"), std::string::npos) << name;
    fs::remove(folder / name);
    ASSERT_EQ(::mkfifo((folder / name).c_str(), 0600), 0);
    EXPECT_NE(error_text(folder / name, folder.path()).find("not a regular file"), std::string::npos) << name;
    fs::remove(folder / name);
    fs::create_symlink("/dev/zero", folder / name);
    EXPECT_NE(error_text(folder / name, folder.path()).find("outside the folder"), std::string::npos) << name;
    fs::remove(folder / name);
  }
  EXPECT_NE(error_text("/dev/zero", "/").find("not a regular file"), std::string::npos);
}

TEST(HostileFile, TimeLimitIsAMessage) {
  const test::TempFolder folder;
  LoadLimits limits;
  limits.child.wall_time = std::chrono::milliseconds(1);
  // The loader needs far longer for so many lines, however the machine shares out its time.
  std::string lines;
  for (int i = 0; i < 300'000; ++i) lines += "v 0.25 0.5 0.75\n";
  const fs::path file = folder.write("model.obj", lines + "f 1 2 3\n");
  const auto error = test::error_of([&] { load_model(file, folder.path(), limits); });
  ASSERT_TRUE(error.has_value());
  EXPECT_NE(std::string(error->what()).find("the mesh loader took longer than 0.001 s"), std::string::npos)
      << error->what();
}

TEST(HostileFile, LimitOfTriangles) {
  const test::TempFolder folder;
  LoadLimits limits;
  limits.model.triangles = 1;
  const std::string two = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n";
  const auto error = test::error_of([&] { load_model(folder.write("a.obj", two), folder.path(), limits); });
  ASSERT_TRUE(error.has_value());
  EXPECT_NE(std::string(error->what()).find("limit"), std::string::npos);
}

}  // namespace
}  // namespace hallway::mesh
