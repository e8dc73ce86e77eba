// SPDX-License-Identifier: MIT
// The GLB files that we write, as the Khronos validator sees them.
#include <gtest/gtest.h>

#include <cstring>

#include "mesh/export.hpp"
#include "node/validator.hpp"
#include "unit/mesh/models.hpp"

namespace hallway::mesh {
namespace {

mesh::Model with_hard_numbers() {
  Model model = test::random_model(9, 300);
  model.vertices[0] = {0.1, -1e-30, 123456.789};
  model.vertices[1] = {-0.0, 1e8, 1.0 / 3.0};
  model.triangles.push_back({{0, 1, 2}, 0});
  model.triangles.push_back({{1, 1, 1}, 1});  // without area
  model.materials[0].name = "w\xc3\xa4nde \"und\" \\ \x01 \xff";
  return model;
}

mesh::Model with_holes() {
  Model model = test::tiles();
  model.images[1].rgba[3] = 0;
  model.images[1].name = "\xff \"holes\"";
  model.materials[1].image = 0;
  model.materials[1].base_colour[3] = 0.5F;
  return model;
}

TEST(GltfValidator, FindsNothingWrongInWhatWeWrite) {
  HALLWAY_GLTF_VALIDATOR_OR_SKIP(validator);
  const test::TempFolder folder;
  for (const Model& model : {test::cube(), test::random_model(8, 2000), with_hard_numbers(), with_holes(),
                             test::tiles(), Model{}}) {
    const test::Ended ended = test::validate_gltf(validator, folder.write("a.glb", to_glb(model)));
    EXPECT_EQ(ended.status, 0) << ended.out << ended.err;
  }
}

TEST(GltfValidator, FindsWhatIsWrong) {
  HALLWAY_GLTF_VALIDATOR_OR_SKIP(validator);
  const test::TempFolder folder;
  std::string glb = to_glb(test::cube());
  const std::size_t binary = glb.find(std::string("BIN\0", 4)) + 4;
  const float other = 7.0F;
  std::memcpy(glb.data() + binary, &other, sizeof other);  // a position beyond the accessor's max
  const test::Ended ended = test::validate_gltf(validator, folder.write("a.glb", glb));
  EXPECT_EQ(ended.status, 1) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("ACCESSOR_MAX_MISMATCH"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace hallway::mesh
