// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "map/reader.hpp"
#include "map/texture_axes.hpp"
#include "map/world.hpp"
#include "map/writer.hpp"
#include "map_text.hpp"
#include "same_document.hpp"
#include "support/long_mode.hpp"

namespace hallway::map {
namespace {

using test::cube_faces;
using test::map_of;

/// What a face of the Standard format says.
struct StandardTexture {
  double u_offset;
  double v_offset;
  double rotation_deg;
  double u_scale;
  double v_scale;
};

/// The editor's formula: it turns the coordinates, not the axes.
Vec2 coordinates_by_the_editor(const std::array<Vec3, 3>& points, const StandardTexture& texture,
                               const Vec3& at) {
  static const std::array<std::array<double, 9>, 6> kBase{{{0, 0, 1, 1, 0, 0, 0, -1, 0},
                                                           {0, 0, -1, 1, 0, 0, 0, -1, 0},
                                                           {1, 0, 0, 0, 1, 0, 0, 0, -1},
                                                           {-1, 0, 0, 0, 1, 0, 0, 0, -1},
                                                           {0, 1, 0, 1, 0, 0, 0, 0, -1},
                                                           {0, -1, 0, 1, 0, 0, 0, 0, -1}}};
  const Vec3 normal = (points[0] - points[1]).cross(points[2] - points[1]).normalized();
  double best = 0.0;
  const std::array<double, 9>* row = &kBase[0];
  for (const auto& base : kBase) {
    const double along = normal.x() * base[0] + normal.y() * base[1] + normal.z() * base[2];
    if (along <= best) continue;
    best = along;
    row = &base;
  }
  const double s = at.dot(Vec3((*row)[3], (*row)[4], (*row)[5]));
  const double t = at.dot(Vec3((*row)[6], (*row)[7], (*row)[8]));
  const double angle = texture.rotation_deg / 180.0 * std::numbers::pi;
  return {(std::cos(angle) * s - std::sin(angle) * t) / texture.u_scale + texture.u_offset,
          (std::sin(angle) * s + std::cos(angle) * t) / texture.v_scale + texture.v_offset};
}

Vec2 coordinates_by_axes(const Face& face, const Vec3& at) {
  return {face.u_axis.dot(at) / face.u_scale + face.u_offset,
          face.v_axis.dot(at) / face.v_scale + face.v_offset};
}

std::string standard_face(const std::array<Vec3, 3>& points, const StandardTexture& texture) {
  std::string text;
  for (const Vec3& p : points)
    text += "( " + format_double(p.x()) + " " + format_double(p.y()) + " " + format_double(p.z()) + " ) ";
  text += "wall";
  for (const double number :
       {texture.u_offset, texture.v_offset, texture.rotation_deg, texture.u_scale, texture.v_scale})
    text += " " + format_double(number);
  return text + "\n";
}

const Face& first_face(const Document& document) {
  return document.entities.at(0).brushes.at(0).faces.at(0);
}

TEST(StandardFormat, TextureCoordinatesAreThoseOfTheEditor) {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto whole = [&] {
    return std::round(64.0 * unit(random));
  };  // so that some normals are as near to two axes
  const int count = hallway::test::sized(2000, 200000);
  for (int i = 0; i < count; ++i) {
    std::array<Vec3, 3> points;
    for (Vec3& point : points) {
      const double x = i % 3 ? whole() : std::round(unit(random));
      const double y = i % 3 ? whole() : std::round(unit(random));
      point = {x, y, i % 3 ? whole() : std::round(unit(random))};
    }
    if ((points[1] - points[0]).cross(points[2] - points[0]).norm() == 0.0) continue;
    const double rotation = i % 2 ? 90.0 * std::round(8.0 * unit(random)) : 360.0 * unit(random);
    const StandardTexture texture{whole(), whole(), rotation, i % 5 ? 2.0 : -0.25, 1.0 + 0.5 * unit(random)};
    const Face face = first_face(parse(map_of(standard_face(points, texture)), "a.map"));
    const Vec3 at(100.0 * unit(random), 100.0 * unit(random), 100.0 * unit(random));
    const Vec2 expected = coordinates_by_the_editor(points, texture, at);
    ASSERT_LT((coordinates_by_axes(face, at) - expected).norm(), 1e-9 * (1.0 + expected.norm()))
        << standard_face(points, texture);
  }
}

TEST(StandardFormat, QuarterTurnsAreExact) {
  const std::array<Vec3, 3> floor{Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0)};
  EXPECT_EQ(standard_axes(floor, 0.0).u, Vec3::UnitX());
  EXPECT_EQ(standard_axes(floor, 0.0).v, -Vec3::UnitY());
  EXPECT_EQ(standard_axes(floor, 90.0).u, Vec3::UnitY());
  EXPECT_EQ(standard_axes(floor, 90.0).v, Vec3::UnitX());
  EXPECT_EQ(standard_axes(floor, -270.0).u, Vec3::UnitY());
  EXPECT_EQ(standard_axes(floor, 450.0).u, Vec3::UnitY());
  EXPECT_EQ(standard_axes(floor, 180.0).u, -Vec3::UnitX());
}

TEST(StandardFormat, AScaleOfZeroIsOne) {
  const Document document = parse(map_of("( 0 0 0 ) ( 0 1 0 ) ( 1 0 0 ) m 1 2 0 0 0\n"), "a.map");
  EXPECT_EQ(first_face(document).u_scale, 1.0);
  EXPECT_EQ(first_face(document).v_scale, 1.0);
}

TEST(StandardFormat, FacesOfBothFormatsMixed) {
  std::string faces = cube_faces();
  const std::size_t axes = faces.find(" [");
  faces.replace(axes, faces.find('\n') - axes, " 3 4 90 2 0.5 1 2 3");
  const Document document = parse(map_of(faces), "a.map");
  const World world = build_world(document);
  EXPECT_TRUE(world.problems.empty());
  EXPECT_EQ(world.solids.size(), 1u);
  const Face& face = first_face(document);
  EXPECT_EQ(face.u_offset, 3.0);
  EXPECT_EQ(face.v_offset, 4.0);
  EXPECT_EQ(face.rotation_deg, 90.0);
  ASSERT_TRUE(face.surface_flags);
  EXPECT_EQ(face.surface_flags->flags, 2);
}

TEST(StandardFormat, IsWrittenAsValve220) {
  const Document document = parse(map_of("( 0 0 0 ) ( 0 1 0 ) ( 1 0 0 ) m 1 2 0 1 1\n"), "a.map");
  const std::string text = print(document);
  EXPECT_NE(text.find("m [ 1 0 0 1 ] [ 0 -1 0 2 ] 0 1 1\n"), std::string::npos) << text;
  EXPECT_EQ(test::difference(parse(text, "b.map"), document), "");
}

TEST(StandardFormat, PointsThatMakeNoPlaneAreNoTroubleToTheReader) {
  EXPECT_EQ(first_face(parse(map_of("( 0 0 0 ) ( 1e308 0 0 ) ( -1e308 0 1e308 ) m 0 0 1e300 1 1\n"), "a.map"))
                .u_axis.array()
                .isFinite()
                .all(),
            true);
}

std::string as_primitive(std::string faces) {
  const std::string axes = "wall [ 1 0 0 0 ] [ 0 -1 0 0 ] 0 1 1";
  for (std::size_t at = faces.find(axes); at != std::string::npos; at = faces.find(axes))
    faces.replace(at, axes.size(), "( ( 0.5 0 1 ) ( 0 0.25 2 ) ) base/stone 0 4 0");
  return "brushDef\n{\n" + faces + "}\n";
}

TEST(BrushPrimitive, IsASolidLikeAnyOther) {
  const Document document = parse(map_of(as_primitive(cube_faces())), "a.map");
  const World world = build_world(document);
  EXPECT_TRUE(world.problems.empty());
  ASSERT_EQ(world.solids.size(), 1u);
  EXPECT_EQ(world.bounds.max(), Vec3::Constant(2.0));
  EXPECT_EQ(world.solids[0].faces[0].material, "base/stone");
}

TEST(BrushPrimitive, KeepsItsMatrixWhenWritten) {
  const Document document = parse(map_of(as_primitive(cube_faces())), "a.map");
  ASSERT_TRUE(first_face(document).texture_matrix);
  EXPECT_EQ(*first_face(document).texture_matrix, (std::array<double, 6>{0.5, 0, 1, 0, 0.25, 2}));
  const std::string text = print(document);
  EXPECT_NE(text.find("( ( 0.5 0 1 ) ( 0 0.25 2 ) ) base/stone 0 4 0\n"), std::string::npos) << text;
  EXPECT_EQ(test::difference(parse(text, "b.map"), document), "");
}

const std::string kPatch =
    "patchDef2 // a { curve\n{\ncommon/caulk\n( 3 3 0 0 0 )\n(\n( ( 0 0 0 0 0 ) ) ; }\n\"}\n)\n}";

TEST(Patch, IsAProblemAndTheRestStands) {
  const std::string text = map_of(cube_faces() + "}\n{\n" + kPatch + "\n");
  const World world = build_world(parse(text, "a.map"));
  EXPECT_EQ(world.solids.size(), 1u);
  ASSERT_EQ(world.problems.size(), 1u);
  EXPECT_EQ(world.problems[0].line, 11);
  EXPECT_EQ(world.problems[0].brush, 1);
  EXPECT_EQ(world.problems[0].message, "`patchDef2`: patches are not read");
}

TEST(Patch, IsWrittenAsItStood) {
  const Document document = parse(map_of("// before\n" + kPatch + " // after\n"), "a.map");
  const Brush& brush = document.entities.at(0).brushes.at(0);
  EXPECT_EQ(brush.unread, kPatch);
  EXPECT_EQ(brush.comments, std::vector<std::string>{"before"});
  EXPECT_EQ(brush.closing_comments, std::vector<std::string>{"after"});
  EXPECT_NE(print(document).find(kPatch), std::string::npos);
  EXPECT_EQ(test::difference(parse(print(document), "b.map"), document), "");
}

TEST(Patch, BrushesOfPlanesAreNotReadEither) {
  const World world = build_world(
      parse(map_of("brushDef3\n{\n( 0 0 1 -8 ) ( ( 1 0 0 ) ( 0 1 0 ) ) \"m\" 0 0 0\n}\n"), "a.map"));
  ASSERT_EQ(world.problems.size(), 1u);
  EXPECT_EQ(world.problems[0].message, "`brushDef3`: this form of brush is not read; `brushDef` is");
}

}  // namespace
}  // namespace hallway::map
