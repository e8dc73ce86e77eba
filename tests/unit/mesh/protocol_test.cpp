// SPDX-License-Identifier: MIT
#include "mesh/protocol.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "support/errors.hpp"
#include "support/long_mode.hpp"
#include "unit/mesh/models.hpp"

namespace hallway::mesh {
namespace {

std::string encoded(const Model& model) {
  std::string message;
  encode_model(model, [&](std::string_view bytes) { message.append(bytes); });
  return message;
}

Model full_model() {
  Model model = test::cube();
  model.uv.resize(model.vertices.size(), {0.25F, -3.0F});
  model.images = {{"wood", 2, 1, {1, 2, 3, 4, 5, 6, 7, 8}}};
  model.materials[1].image = 0;
  model.metres_per_unit = 0.0254;
  model.files = {"a.glb", "b.png"};
  model.warnings = {"one", "two"};
  return model;
}

std::string cause_of(const std::string& message, const ModelLimits& limits = {}) {
  const auto error = test::error_of([&] { decode_reply(message, limits); });
  return error ? error->what() : "";
}

TEST(Protocol, ModelComesBackAsItWas) {
  const Model model = full_model();
  const Model back = decode_reply(encoded(model), {});
  EXPECT_EQ(back.vertices, model.vertices);
  EXPECT_EQ(back.uv, model.uv);
  ASSERT_EQ(back.triangles.size(), model.triangles.size());
  for (std::size_t i = 0; i < model.triangles.size(); ++i) {
    EXPECT_EQ(back.triangles[i].vertices, model.triangles[i].vertices);
    EXPECT_EQ(back.triangles[i].material, model.triangles[i].material);
  }
  EXPECT_EQ(back.materials.at(0).name, "red paint");
  EXPECT_EQ(back.materials.at(0).base_colour, model.materials[0].base_colour);
  EXPECT_FALSE(back.materials.at(0).image.has_value());
  EXPECT_EQ(back.materials.at(1).image, 0u);
  EXPECT_EQ(back.images.at(0).rgba, model.images[0].rgba);
  EXPECT_EQ(back.metres_per_unit, model.metres_per_unit);
  EXPECT_EQ(back.files, model.files);
  EXPECT_EQ(back.warnings, model.warnings);
  EXPECT_EQ(encoded(back), encoded(model));
}

TEST(Protocol, RequestComesBackAsItWas) {
  LoadRequest request{"/a/b.glb", "/a", {}};
  request.limits.triangles = 7;
  request.limits.file_bytes = 9;
  const LoadRequest back = decode_request(encode_request(request));
  EXPECT_EQ(back.file, request.file);
  EXPECT_EQ(back.root, request.root);
  EXPECT_EQ(back.limits.triangles, 7u);
  EXPECT_EQ(back.limits.file_bytes, 9u);
}

TEST(Protocol, FailureIsThrownAgain) {
  const std::string message =
      encode_failure(Error(ErrorCode::kIo, "cannot open\x1b[31m", {.file = "b.bin", .element = "node 3"}));
  const auto error = test::error_of([&] { decode_reply(message, {}); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code(), ErrorCode::kIo);
  EXPECT_STREQ(error->what(), "b.bin: node 3: cannot open\\x1b[31m");
}

TEST(Protocol, EveryCutIsAnError) {
  for (const std::string& message : {encoded(full_model()), encode_failure(Error(ErrorCode::kIo, "x"))}) {
    for (std::size_t size = 0; size < message.size(); ++size)
      EXPECT_NE(cause_of(message.substr(0, size)), "") << size;
    EXPECT_NE(cause_of(message + "x"), "");
  }
}

TEST(Protocol, EveryFlippedBitIsAnErrorOrAValidModel) {
  const std::string message = encoded(full_model());
  std::size_t refused = 0;
  for (std::size_t bit = 0; bit < 8 * message.size(); ++bit) {
    std::string changed = message;
    changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << bit % 8));
    try {
      check_model(decode_reply(changed, {}), {});
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, message.size());
}

TEST(Protocol, CountsAreCheckedBeforeAnythingIsAllocated) {
  const std::string message = encoded(full_model());
  constexpr std::size_t kVertexCount = 16;  // after mark and unit
  for (const std::uint64_t count : {std::uint64_t{1} << 62, ~std::uint64_t{0}, std::uint64_t{29'999'999}}) {
    std::string changed = message;
    std::memcpy(changed.data() + kVertexCount, &count, sizeof count);
    const std::string cause = cause_of(changed);
    EXPECT_TRUE(cause.find("limit") != std::string::npos || cause.find("cut short") != std::string::npos)
        << cause;
  }
}

TEST(Protocol, LimitsHold) {
  const std::string message = encoded(full_model());
  for (std::uint64_t ModelLimits::*limit :
       {&ModelLimits::triangles, &ModelLimits::vertices, &ModelLimits::materials, &ModelLimits::images,
        &ModelLimits::image_bytes}) {
    ModelLimits limits;
    limits.*limit = 0;
    EXPECT_NE(cause_of(message, limits), "");
  }
}

/// Each makes a good model a bad one.
TEST(CheckModel, SaysWhatIsWrong) {
  const auto cause = [](const std::function<void(Model&)>& change) {
    Model model = full_model();
    change(model);
    const auto error = test::error_of([&] { check_model(model, {}); });
    return error ? std::string(error->what()) : std::string();
  };
  EXPECT_EQ(cause([](Model&) {}), "");
  EXPECT_EQ(cause([](Model& m) { m.triangles.clear(); }), "holds no triangles");
  EXPECT_NE(cause([](Model& m) { m.triangles[3].vertices[1] = 8; }).find("triangle 3 names vertex 8 of 8"),
            std::string::npos);
  EXPECT_NE(cause([](Model& m) { m.triangles[0].material = 2; }), "");
  EXPECT_NE(cause([](Model& m) { m.materials[0].image = 1; }), "");
  EXPECT_NE(cause([](Model& m) { m.materials[0].base_colour[2] = 1.5F; }), "");
  EXPECT_NE(cause([](Model& m) { m.materials[0].base_colour[2] = std::numeric_limits<float>::quiet_NaN(); }),
            "");
  EXPECT_NE(cause([](Model& m) { m.vertices[7].y() = std::numeric_limits<double>::quiet_NaN(); }), "");
  EXPECT_NE(cause([](Model& m) { m.vertices[7].y() = -2e9; }), "");
  EXPECT_NE(cause([](Model& m) { m.uv.pop_back(); }), "");
  EXPECT_NE(cause([](Model& m) { m.uv[0][0] = std::numeric_limits<float>::infinity(); }), "");
  EXPECT_NE(cause([](Model& m) { m.images[0].rgba.pop_back(); }), "");
  EXPECT_NE(cause([](Model& m) { m.images[0].width = 0; }), "");
  EXPECT_NE(cause([](Model& m) { m.metres_per_unit = 0.0; }), "");
}

}  // namespace
}  // namespace hallway::mesh
