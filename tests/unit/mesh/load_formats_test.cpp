// SPDX-License-Identifier: MIT
// Axes and units of the formats that assimp reads: the same triangle (0,0,0) (1,0,0) (0,2,3) in each of them.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "mesh/load.hpp"
#include "support/temp_folder.hpp"

namespace hallway::mesh {
namespace {

Model load_text(const std::string& name, const std::string& text) {
  const test::TempFolder folder;
  return load_model(folder.write(name, text), folder.path());
}

void expect_corners(const Model& model, const Vec3& second, const Vec3& third) {
  ASSERT_EQ(model.triangles.size(), 1u);
  const auto& corners = model.triangles[0].vertices;
  EXPECT_LT(model.vertices.at(corners[0]).norm(), 1e-6);
  EXPECT_LT((model.vertices.at(corners[1]) - second).norm(), 1e-6)
      << model.vertices.at(corners[1]).transpose();
  EXPECT_LT((model.vertices.at(corners[2]) - third).norm(), 1e-6)
      << model.vertices.at(corners[2]).transpose();
}

std::string collada(const std::string& up, double metres) {
  return fmt::format(R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="{}" name="u"/><up_axis>{}</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="p">
<float_array id="pa" count="9">0 0 0 1 0 0 0 2 3</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry>
</library_geometries><library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
)",
                     metres, up);
}

std::string fbx(int up, int front, int front_sign, double centimetres) {
  return fmt::format(R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {{
	FBXHeaderVersion: 1003
	FBXVersion: 7400
}}
GlobalSettings:  {{
	Version: 1000
	Properties70:  {{
		P: "UpAxis", "int", "Integer", "",{}
		P: "UpAxisSign", "int", "Integer", "",1
		P: "FrontAxis", "int", "Integer", "",{}
		P: "FrontAxisSign", "int", "Integer", "",{}
		P: "CoordAxis", "int", "Integer", "",0
		P: "CoordAxisSign", "int", "Integer", "",1
		P: "UnitScaleFactor", "double", "Number", "",{}
	}}
}}
Objects:  {{
	Geometry: 1, "Geometry::t", "Mesh" {{
		Vertices: *9 {{
			a: 0,0,0,1,0,0,0,2,3
		}}
		PolygonVertexIndex: *3 {{
			a: 0,1,-3
		}}
		GeometryVersion: 124
	}}
	Model: 2, "Model::t", "Mesh" {{
		Version: 232
	}}
}}
Connections:  {{
	C: "OO",2,0
	C: "OO",1,2
}}
)",
                     up, front, front_sign, centimetres);
}

TEST(LoadFormats, ColladaSaysItsAxesAndUnit) {
  expect_corners(load_text("a.dae", collada("Z_UP", 0.5)), {0.5, 0, 0}, {0, 1, 1.5});
  expect_corners(load_text("a.dae", collada("Y_UP", 2.0)), {2, 0, 0}, {0, -6, 4});
  EXPECT_EQ(load_text("a.dae", collada("Z_UP", 0.0254)).metres_per_unit, 0.0254);
}

TEST(LoadFormats, FbxSaysItsAxesAndUnit) {
  expect_corners(load_text("a.fbx", fbx(1, 2, 1, 100.0)), {1, 0, 0}, {0, -3, 2});
  expect_corners(load_text("a.fbx", fbx(2, 1, -1, 100.0)), {1, 0, 0}, {0, 2, 3});
  expect_corners(load_text("a.fbx", fbx(2, 1, -1, 2.54)), {0.0254, 0, 0}, {0, 0.0508, 0.0762});
  EXPECT_EQ(load_text("a.fbx", fbx(1, 2, 1, 1.0)).metres_per_unit, 0.01);
}

TEST(LoadFormats, OthersStandAsTheyAre) {
  const Vec3 second(1, 0, 0);
  const Vec3 third(0, 2, 3);
  expect_corners(load_text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 2 3\nf 1 2 3\n"), second, third);
  expect_corners(load_text("A.OBJ", "v 0 0 0\nv 1 0 0\nv 0 2 3\nf 1 2 3\n"), second, third);
  expect_corners(load_text("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 2 3\n3 0 1 2\n"), second, third);
  expect_corners(
      load_text("a.stl",
                "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 2 3\n"
                "endloop\nendfacet\nendsolid x\n"),
      second, third);
  expect_corners(
      load_text("a.ply",
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                "0 0 0\n1 0 0\n0 2 3\n3 0 1 2\n"),
      second, third);
}

TEST(LoadFormats, PolygonsBecomeTrianglesAndLinesAreLeftOut) {
  const Model model = load_text("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nf 1 2 3 4\nl 1 5\n");
  EXPECT_EQ(model.triangles.size(), 2u);
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_EQ(model.warnings[0], "1 points and lines are left out");
}

TEST(LoadFormats, ObjWithItsMaterialsAndPicture) {
  const test::TempFolder folder;
  std::string bmp("BM\x3a\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\1\0\0\0\1\0\0\0\1\0\x18\0", 30);
  bmp += std::string(24, '\0') + std::string("\x30\x20\x10\0", 4);
  std::filesystem::create_directory(folder / "textures");
  folder.write("textures/wood.bmp", bmp);
  folder.write("a.mtl", "newmtl red\nKd 1 0.25 0\nnewmtl wood\nKd 1 1 1\nmap_Kd textures\\wood.bmp\n");
  const Model model = load_model(
      folder.write(
          "a.obj",
          "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl wood\nf 1/1 2/2 3/3\n"
          "usemtl red\nf 1 3 2\n"),
      folder.path());
  ASSERT_EQ(model.triangles.size(), 2u);
  EXPECT_TRUE(model.warnings.empty()) << model.warnings.front();
  ASSERT_EQ(model.images.size(), 1u);
  EXPECT_EQ(model.images[0].rgba, (std::vector<std::uint8_t>{0x10, 0x20, 0x30, 0xFF}));
  EXPECT_EQ(model.files, (std::vector<std::string>{"a.mtl", "a.obj", "textures/wood.bmp"}));
  int textured = 0;
  for (const Triangle& triangle : model.triangles) {
    const Material& material = model.materials.at(triangle.material);
    if (!material.image) {
      EXPECT_EQ(material.base_colour, (std::array<float, 4>{1.0F, 0.25F, 0.0F, 1.0F}));
      continue;
    }
    ++textured;
    // OBJ counts rows from below, we from above.
    for (const std::uint32_t vertex : triangle.vertices) {
      const Vec3& p = model.vertices.at(vertex);
      EXPECT_FLOAT_EQ(model.uv.at(vertex)[0], static_cast<float>(p.x()));
      EXPECT_FLOAT_EQ(model.uv.at(vertex)[1], 1.0F - static_cast<float>(p.y()));
    }
  }
  EXPECT_EQ(textured, 1);
}

}  // namespace
}  // namespace hallway::mesh
