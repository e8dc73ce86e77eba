// SPDX-License-Identifier: MIT
// Models of others: good ones, and ones with deliberate faults.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "base/parallel.hpp"
#include "mesh/load.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/mesh/gltf_text.hpp"

namespace hallway::mesh {
namespace {

namespace fs = std::filesystem;

struct Outcome {
  std::size_t triangles = 0;
  std::string error;
};

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<Outcome> load_all(const std::vector<fs::path>& files, const fs::path& root) {
  std::vector<Outcome> outcomes(files.size());
  parallel_for(files.size(), 1, 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      try {
        const Model model = load_model(files[i], root);
        check_model(model, {});
        outcomes[i].triangles = model.triangles.size();
      } catch (const Error& error) {
        outcomes[i].error = error.what();
      }
    }
  });
  return outcomes;
}

TEST(LoadData, EveryFileIsAModelOrAnError) {
  HALLWAY_DATA_OR_SKIP(folder, "models");
  const std::vector<fs::path> files = files_below(folder);
  EXPECT_GE(files.size(), 350u);
  const std::vector<Outcome> outcomes = load_all(files, folder);
  std::size_t crashed = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_NE(outcomes[i].triangles > 0, !outcomes[i].error.empty()) << files[i];
    if (!outcomes[i].error.empty()) {
      EXPECT_TRUE(outcomes[i].error.starts_with(files[i].string())) << outcomes[i].error;
    }
    crashed += outcomes[i].error.find("crashed") != std::string::npos;
  }
  RecordProperty("crashed", static_cast<int>(crashed));
}

TEST(LoadData, GoodModelsHaveTheirTriangles) {
  HALLWAY_DATA_OR_SKIP(folder, "models");
  const std::map<std::string, std::size_t> expected{
      {"buildings/apartment/meshes/apartment.dae", 7362},
      {"buildings/house_1/meshes/house_1.dae", 1884},
      {"buildings/willowgarage/meshes/willowgarage_collision.dae", 13'348},  // and 36 lines
      {"buildings/willowgarage/meshes/willowgarage_visual.dae", 13'839},     // and 22 lines
      {"gltf/Box/glTF-Binary/Box.glb", 12},
      {"gltf/BoxInterleaved/glTF/BoxInterleaved.gltf", 12},
      {"gltf/Duck/glTF/Duck.gltf", 4212},
      {"gltf/Duck/glTF-Embedded/Duck.gltf", 4212},
      {"gltf/Duck/glTF-Binary/Duck.glb", 4212},
      {"gltf/SimpleMeshes/glTF/SimpleMeshes.gltf", 2},
      {"gltf/SimpleSparseAccessor/glTF/SimpleSparseAccessor.gltf", 12}};
  for (const auto& [name, triangles] : expected) {
    EXPECT_EQ(load_model(folder / name, folder).triangles.size(), triangles) << name;
  }
}

TEST(LoadData, BuildingsHaveTheirSizeAndTextures) {
  HALLWAY_DATA_OR_SKIP(folder, "models/buildings/willowgarage");
  const Model model = load_model(folder / "meshes/willowgarage_visual.dae", folder);
  const Box bounds = bounds_of(model);
  EXPECT_NEAR(bounds.sizes().z(), 2.845, 0.01);  // a room's height, so inches became metres and z is up
  EXPECT_NEAR(bounds.sizes().x(), 58.6, 0.1);
  EXPECT_EQ(model.metres_per_unit, 0.02539999969303608);
  EXPECT_EQ(model.images.size(), 7u);
}

TEST(LoadData, TexturesOutsideTheFolderAreLeftOut) {
  HALLWAY_DATA_OR_SKIP(folder, "models/buildings/willowgarage/meshes");
  const Model model = load_model(folder / "willowgarage_visual.dae", folder);
  EXPECT_TRUE(model.images.empty());
  EXPECT_GE(model.warnings.size(), 7u);
  EXPECT_EQ(model.files, std::vector<std::string>{"willowgarage_visual.dae"});
}

/// Files in which the Khronos validator finds no error must not be refused as damaged.
TEST(LoadData, ValidFilesAreNotCalledDamaged) {
  HALLWAY_DATA_OR_SKIP(folder, "models/gltf");
  for (const fs::path& file : files_below(folder)) {
    if (file.extension() != ".gltf" && file.extension() != ".glb") continue;
    EXPECT_NO_THROW(load_model(file, folder)) << file;
  }
}

TEST(LoadData, ImagesThatCrashedDecoders) {
  HALLWAY_DATA_OR_SKIP(folder, "models/bad_png");
  const test::TempFolder temp;
  for (const fs::path& image : files_below(folder)) {
    if (image.extension() != ".png") continue;
    temp.write("picture.png", read_file(image));
    test::Json json = test::triangle_gltf();
    json["images"] = {{{"uri", "picture.png"}}};
    json["textures"] = test::Json::parse(R"([{"source": 0}])");
    json["materials"] =
        test::Json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
    const auto error = test::error_of([&] {
      const Model model = load_model(temp.write("model.gltf", json.dump()), temp.path());
      EXPECT_EQ(model.images.size() + model.warnings.size(), 1u) << image;
    });
    if (error) {
      EXPECT_NE(std::string(error->what()).find("over the limit"), std::string::npos)
          << image << error->what();
    }
  }
}

}  // namespace
}  // namespace hallway::mesh
