// SPDX-License-Identifier: MIT
// What we write is what we read again.
#include "mesh/export.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/load.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/mesh/models.hpp"

namespace hallway::mesh {
namespace {

using Corners = std::array<std::array<float, 3>, 3>;

/// Corners of all triangles as 32-bit floats, in order of material.
std::vector<Corners> corners_by_material(const Model& model) {
  std::vector<Corners> result;
  for (std::uint32_t material = 0; material < model.materials.size(); ++material) {
    for (const Triangle& triangle : model.triangles) {
      if (triangle.material != material) continue;
      Corners corners{};
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& p = model.vertices[triangle.vertices[i]];
        corners[i] = {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
      }
      result.push_back(corners);
    }
  }
  return result;
}

Model written_and_read(const std::string& name, const std::string& bytes) {
  const test::TempFolder folder;
  return load_model(folder.write(name, bytes), folder.path());
}

Model obj_and_back(const Model& model) {
  const test::TempFolder folder;
  const ObjFiles files = to_obj(model, "a.mtl");
  for (const ObjFiles::File& image : files.images) folder.write(image.name, image.bytes);
  folder.write("a.mtl", files.mtl);
  return load_model(folder.write("a.obj", files.obj), folder.path());
}

TEST(Export, GlbComesBack) {
  for (const Model& model : {test::cube(), test::random_model(1, 500)}) {
    const Model back = written_and_read("a.glb", to_glb(model));
    EXPECT_EQ(corners_by_material(back), corners_by_material(model));
    EXPECT_EQ(to_glb(back), to_glb(written_and_read("a.glb", to_glb(back))));
  }
  const Model back = written_and_read("a.glb", to_glb(test::cube()));
  ASSERT_EQ(back.materials.size(), 2u);
  EXPECT_EQ(back.materials[0].name, "red paint");
  EXPECT_EQ(back.materials[1].base_colour, test::cube().materials[1].base_colour);
}

TEST(Export, ObjComesBack) {
  for (const Model& model : {test::cube(), test::random_model(2, 500)}) {
    const auto back = corners_by_material(obj_and_back(model));
    const auto wanted = corners_by_material(model);
    ASSERT_EQ(back.size(), wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      for (std::size_t k = 0; k < 9; ++k) {
        // The reader's decimals are good to the last bit of a float but one.
        EXPECT_NEAR(back[i][k / 3][k % 3], wanted[i][k / 3][k % 3], 4e-6F) << i;
      }
    }
  }
  const Model back = obj_and_back(test::cube());
  const Material& red = back.materials.at(back.triangles.front().material);
  EXPECT_EQ(red.base_colour, test::cube().materials[0].base_colour);
}

TEST(Export, PlyComesBack) {
  for (Model model : {test::cube(), test::random_model(3, 500)}) {
    const Model back = written_and_read("a.ply", to_ply(model));
    // One material comes back; the order is that of the file.
    for (Triangle& triangle : model.triangles) triangle.material = 0;
    Model flat = back;
    for (Triangle& triangle : flat.triangles) triangle.material = 0;
    EXPECT_EQ(corners_by_material(flat), corners_by_material(model));
  }
}

/// Position and texture coordinates of each corner of the triangles that show an image, as 32-bit floats.
std::vector<std::array<float, 5>> textured_corners(const Model& model) {
  std::vector<std::array<float, 5>> corners;
  for (const Triangle& triangle : model.triangles) {
    if (!shows_image(model, model.materials[triangle.material])) continue;
    for (const std::uint32_t vertex : triangle.vertices) {
      const Vec3& p = model.vertices[vertex];
      const auto& [u, v] = model.uv[vertex];
      corners.push_back(
          {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), u, v});
    }
  }
  return corners;
}

/// What the first triangle shows.
struct Look {
  std::array<float, 4> base_colour;
  Image image;
};

Look look_of(const Model& model) {
  const Material& material = model.materials.at(model.triangles.at(0).material);
  return {material.base_colour, model.images.at(material.image.value())};
}

TEST(Export, TexturesComeBack) {
  for (const bool holes : {false, true}) {
    Model model = test::tiles();
    if (holes) model.images[1].rgba[7] = 10;
    for (const Model& back : {written_and_read("a.glb", to_glb(model)), obj_and_back(model)}) {
      EXPECT_TRUE(back.warnings.empty()) << back.warnings.front();
      EXPECT_EQ(textured_corners(back), textured_corners(model));
      EXPECT_EQ(look_of(back).base_colour, model.materials[0].base_colour);
      EXPECT_EQ(look_of(back).image.width, 2u);
      EXPECT_EQ(look_of(back).image.height, 2u);
      EXPECT_EQ(look_of(back).image.rgba, model.images[1].rgba);
      EXPECT_EQ(back.images.size(), 1u);  // what nothing shows is left out
      EXPECT_FALSE(shows_image(back, back.materials.at(back.triangles.at(2).material)));
    }
    EXPECT_EQ(written_and_read("a.glb", to_glb(model)).images[0].name, "four");
    EXPECT_EQ(to_glb(model), to_glb(model));
  }
}

TEST(Export, ImageOfSeveralMaterialsIsWrittenOnce) {
  Model model = test::tiles();
  model.materials[1].image = 1;
  EXPECT_EQ(written_and_read("a.glb", to_glb(model)).images.size(), 1u);
  EXPECT_EQ(to_obj(model, "some.name.mtl").images.size(), 1u);
  EXPECT_EQ(to_obj(model, "some.name.mtl").images[0].name, "some.name_0.png");
}

TEST(Export, ImageWithoutTextureCoordinatesIsLeftOut) {
  Model model = test::tiles();
  model.uv.clear();
  EXPECT_TRUE(written_and_read("a.glb", to_glb(model)).images.empty());
  EXPECT_TRUE(to_obj(model, "a.mtl").images.empty());
}

TEST(Append, KeepsWhatBothShow) {
  Model model = test::cube();
  append(model, test::tiles());
  append(model, test::tiles());
  check_model(model, {});
  EXPECT_EQ(model.images.size(), 2u);  // the same ones
  EXPECT_EQ(model.materials.size(), 6u);
  auto twice = textured_corners(test::tiles());
  twice.insert(twice.end(), twice.begin(), twice.begin() + 6);
  EXPECT_EQ(textured_corners(model), twice);
  ASSERT_EQ(model.triangles.size(), 18u);
  EXPECT_EQ(model.images[*model.materials[model.triangles[12].material].image], test::tiles().images[1]);
  EXPECT_EQ(model.vertices[model.triangles[17].vertices[2]], Vec3(0, 0, 1));
  EXPECT_EQ(model.materials[model.triangles[17].material].name, "plain");
}

TEST(Export, MaterialsThatAreNotUsedAreLeftOut) {
  Model model = test::cube();
  for (Triangle& triangle : model.triangles) triangle.material = 1;
  EXPECT_EQ(written_and_read("a.glb", to_glb(model)).materials.size(), 1u);
}

TEST(Export, PointsAreTheirBytes) {
  const std::vector<Vec3> points{{1.0, 2.0, 3.0}, {0.1, -0.2, 1e-30}};
  const std::string ply = points_to_ply(points);
  EXPECT_NE(ply.find("element vertex 2\n"), std::string::npos);
  const std::size_t body = ply.find("end_header\n") + 11;
  ASSERT_EQ(ply.size() - body, 48u);
  for (std::size_t i = 0; i < 2; ++i) {
    Vec3 back;
    std::memcpy(back.data(), ply.data() + body + 24 * i, 24);
    EXPECT_EQ(back, points[i]);
  }
  EXPECT_NE(points_to_ply({}).find("element vertex 0\n"), std::string::npos);
}

TEST(Export, EmptyModelIsAFileToo) {
  EXPECT_TRUE(to_glb({}).starts_with("glTF"));
  EXPECT_NE(to_ply({}).find("element face 0\n"), std::string::npos);
  EXPECT_NE(to_obj({}, "a.mtl").obj.find("mtllib a.mtl"), std::string::npos);
}

TEST(Export, BadModelIsRefused) {
  Model model = test::cube();
  model.vertices[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(test::error_of([&] { to_glb(model); }).has_value());
  EXPECT_TRUE(test::error_of([&] { to_obj(model, "a.mtl"); }).has_value());
  EXPECT_TRUE(test::error_of([&] { to_ply(model); }).has_value());
  EXPECT_TRUE(test::error_of([&] { points_to_ply(model.vertices); }).has_value());
}

TEST(Export, NamesWithoutHarm) {
  Model model = test::cube();
  model.materials[0].name = "a b\nusemtl evil # \\ \x1b";
  model.materials[1].name = "";
  EXPECT_EQ(corners_by_material(obj_and_back(model)), corners_by_material(model));
  EXPECT_EQ(corners_by_material(written_and_read("a.glb", to_glb(model))), corners_by_material(model));
}

}  // namespace
}  // namespace hallway::mesh
