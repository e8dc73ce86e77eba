// SPDX-License-Identifier: MIT
// Good models with bytes changed or cut off: whatever that does to the readers, the outcome is a sound model or an Error.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "mesh/export.hpp"
#include "mesh/load.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/long_mode.hpp"
#include "support/temp_folder.hpp"
#include "unit/mesh/gltf_text.hpp"
#include "unit/mesh/models.hpp"

namespace hallway::mesh {
namespace {

namespace fs = std::filesystem;

/// `good` with one to four places changed, digits mostly to other digits, and now and then cut short.
std::string damaged(const std::string& good, const Random& random, std::uint32_t step) {
  static constexpr std::array<std::string_view, 8> kTexts{
      "-1", "99999999999", "1e999", "nan", "\"", "<", std::string_view("\0", 1), "/0"};
  std::string bytes = good;
  const auto first = random.bits(step, 0);
  for (std::uint32_t i = 0; i <= first[0] % 4; ++i) {
    const auto word = random.bits(step, i + 1);
    const std::size_t at = word[0] % bytes.size();
    if (word[1] % 8 == 0) {
      const std::string_view text = kTexts[word[2] % kTexts.size()];
      bytes.replace(at, std::min(text.size(), bytes.size() - at), text);
    } else if (bytes[at] >= '0' && bytes[at] <= '9' && word[1] % 16 != 1) {
      bytes[at] = static_cast<char>('0' + word[2] % 10);
    } else {
      bytes[at] = static_cast<char>(word[2]);
    }
  }
  if (first[1] % 8 == 0) bytes.resize(first[2] % bytes.size());
  return bytes;
}

struct Tally {
  std::size_t models = 0;
  std::size_t errors = 0;
};

Tally load_damaged(const std::string& extension, const std::string& good, std::size_t count) {
  const test::TempFolder folder;
  const Random random(7, stream_id("test.damaged_models." + extension));
  std::vector<int> is_model(count);
  parallel_for(count, 4, 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::string name = std::to_string(i) + "." + extension;
      const fs::path file = folder.write(name, damaged(good, random, static_cast<std::uint32_t>(i)));
      LoadLimits limits;
      limits.child.cpu_seconds = 1;  // some make assimp run for ever
      limits.child.memory_bytes = std::uint64_t{1} << 30;
      const auto error = test::error_of([&] { check_model(load_model(file, folder.path(), limits), {}); });
      if (error && error->where().file != file.string()) ADD_FAILURE() << error->what();
      is_model[i] = !error;
      fs::remove(file);
    }
  });
  const auto models = static_cast<std::size_t>(std::count(is_model.begin(), is_model.end(), 1));
  return {models, count - models};
}

/// The damage must be of a kind that sometimes matters and sometimes does not.
void expect_both(const Tally& tally, const std::string& what) {
  EXPECT_GT(tally.models, 0u) << what;
  EXPECT_GT(tally.errors, 0u) << what;
}

TEST(DamagedModels, OurOwnFiles) {
  const std::size_t count = test::sized<std::size_t>(20, 3000);
  const Model model = test::random_model(4, 12);
  expect_both(load_damaged("obj", to_obj(model, "a.mtl").obj, count), "obj");
  expect_both(load_damaged("ply", to_ply(model), count), "ply");
  expect_both(load_damaged("glb", to_glb(model), count), "glb");
  expect_both(load_damaged("gltf", test::triangle_gltf().dump(1), count), "gltf");
}

TEST(DamagedModels, Building) {
  HALLWAY_DATA_OR_SKIP(file, "models/buildings/house_1/meshes/house_1.dae");
  expect_both(load_damaged("dae", read_file(file), test::sized<std::size_t>(20, 3000)), "dae");
}

}  // namespace
}  // namespace hallway::mesh
