// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "base/error.hpp"
#include "map/reader.hpp"
#include "map/world.hpp"
#include "map_text.hpp"

namespace hallway::map {
namespace {

using test::cube_faces;
using test::document_of;
using test::face_line;
using test::half_space;
using test::map_of;

/// Expects that the first of two brushes is reported at `line` with `cause` and left out, and that the second stands.
void expect_problem(const std::string& faces, int line, const std::string& cause) {
  std::string text = map_of(faces);
  text.insert(text.rfind("}\n"), "{\n" + cube_faces() + "}\n");
  const World world = build_world(parse(text, "a.map"));
  ASSERT_EQ(world.problems.size(), 1u) << cause;
  const Problem& problem = world.problems[0];
  EXPECT_EQ(problem.entity, 0);
  EXPECT_EQ(problem.brush, 0);
  EXPECT_EQ(problem.line, line) << problem.message;
  EXPECT_NE(problem.message.find(cause), std::string::npos) << problem.message;
  ASSERT_EQ(world.solids.size(), 1u);
  EXPECT_EQ(world.solids[0].brush, 1);
}

/// The faces of a box from (0 0 0) to `size`, written with coordinates of any length.
std::string box_faces(const std::string& x, const std::string& y, const std::string& z) {
  return face_line("( 0 0 0 ) ( 0 1 0 ) ( 0 0 1 )") + face_line("( 0 0 0 ) ( 0 0 1 ) ( 1 0 0 )") +
         face_line("( 0 0 0 ) ( 1 0 0 ) ( 0 1 0 )") +
         face_line("( 0 0 " + z + " ) ( 0 1 " + z + " ) ( 1 0 " + z + " )") +
         face_line("( 0 " + y + " 0 ) ( 1 " + y + " 0 ) ( 0 " + y + " 1 )") +
         face_line("( " + x + " 0 0 ) ( " + x + " 0 1 ) ( " + x + " 1 0 )");
}

std::string without_line(std::string text, int line) {
  std::size_t begin = 0;
  for (int i = 0; i < line; ++i) begin = text.find('\n', begin) + 1;
  return text.erase(begin, text.find('\n', begin) + 1 - begin);
}

TEST(WorldProblems, NoFaces) {
  expect_problem("", 3, "the brush has 0 faces");
}

TEST(WorldProblems, ThreeFaces) {
  std::string faces = cube_faces();
  for (int i = 0; i < 3; ++i) faces = without_line(faces, 0);
  expect_problem(faces, 3, "the brush has 3 faces");
}

TEST(WorldProblems, TenThousandFaces) {
  std::string faces;
  for (int i = 0; i < 10000; ++i) faces += face_line("( 0 0 0 ) ( 0 1 0 ) ( 1 0 " + std::to_string(i) + " )");
  expect_problem(faces, 3, "10000 faces; the limit is 1024");
}

TEST(WorldProblems, CollinearPoints) {
  expect_problem(cube_faces() + face_line("( 0 0 0 ) ( 1 1 1 ) ( 3 3 3 )"), 10, "lie on one line");
}

TEST(WorldProblems, RepeatedPoint) {
  expect_problem(cube_faces() + face_line("( 0 0 0 ) ( 1 1 1 ) ( 1 1 1 )"), 10, "points are the same");
}

TEST(WorldProblems, DuplicatePlane) {
  const std::string faces = cube_faces() + face_line("( -64 0 0 ) ( -64 1 0 ) ( -64 0 1 )");
  const World world = build_world(parse(map_of(faces), "a.map"));
  ASSERT_EQ(world.problems.size(), 1u);
  EXPECT_EQ(world.problems[0].line, 10);
  EXPECT_EQ(world.problems[0].message, "the faces at lines 4 and 10 lie on the same plane");
  EXPECT_FALSE(world.problems[0].left_out);
  ASSERT_EQ(world.solids.size(), 1u);  // a body all the same
  EXPECT_EQ(world.solids[0].faces.size(), 6u);
}

TEST(WorldProblems, ParallelPlanesWithoutRoom) {
  expect_problem(cube_faces() + face_line("( -80 0 0 ) ( -80 0 1 ) ( -80 1 0 )"), 10,
                 "the faces at lines 4 and 10 are parallel and leave no room");
}

TEST(WorldProblems, InsideOut) {
  std::string faces;
  for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
    for (const double sign : {-1.0, 1.0}) {
      const Face face = half_space(sign * normal, 64.0);
      for (const int i : {0, 2, 1}) {
        const Vec3& p = face.points[static_cast<std::size_t>(i)];
        faces +=
            "( " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + " ) ";
      }
      faces += face_line("");
    }
  }
  expect_problem(faces, 3, "inside out");
}

TEST(WorldProblems, NotClosed) {
  expect_problem(without_line(cube_faces(), 2), 3, "not closed");
}

TEST(WorldProblems, NothingInside) {
  expect_problem(cube_faces() + face_line("( 300 0 0 ) ( 0 300 0 ) ( 300 0 1 )"), 3,
                 "no point lies behind all faces");
}

TEST(WorldProblems, CoordinateBeyondTheLimit) {
  expect_problem(cube_faces() + face_line("( 2e7 0 0 ) ( 2e7 1 0 ) ( 2e7 0 1 )"), 10,
                 "beyond 16777216 units");
}

TEST(WorldProblems, HugeNumbersAreNoTrouble) {
  expect_problem(cube_faces() + face_line("( 1e308 0 0 ) ( -1e308 1 0 ) ( 1e308 0 1e308 )"), 10, "beyond");
}

TEST(WorldProblems, ASliverOfAMillionthUnit) {
  expect_problem(box_faces("64", "64", "1e-6"), 9 - 2, "leave no room");
}

TEST(World, TenMillionUnitsAreWithinTheLimit) {
  const World world = build_world(parse(map_of(box_faces("1e7", "64", "64")), "a.map"));
  EXPECT_TRUE(world.problems.empty());
  EXPECT_EQ(world.bounds.max().x(), 1e7 / 32.0);
}

TEST(World, AThinSheetIsABody) {
  const World world = build_world(parse(map_of(box_faces("64", "64", "0.001")), "a.map"));
  EXPECT_TRUE(world.problems.empty());
  EXPECT_NEAR(world.bounds.max().z(), 0.001 / 32.0, 1e-12);
}

TEST(WorldProblems, NearlyAlikePlanesEndInABodyOrAReport) {
  for (double angle = 1e-12; angle < 1e-2; angle *= 3.0) {
    Brush brush;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) brush.faces.push_back(half_space(sign * Vec3::Unit(axis), 64.0));
    }
    brush.faces.push_back(half_space(Vec3(std::cos(angle), std::sin(angle), 0.0), 64.0));
    const World world = build_world(document_of(brush));
    const bool left_out = !world.problems.empty() && world.problems[0].left_out;
    EXPECT_EQ(world.solids.size(), left_out ? 0u : 1u);
    EXPECT_LE(world.problems.size(), 1u);
    if (!world.solids.empty()) {
      EXPECT_NEAR(world.solids[0].box.max().x(), 64.0, 1.0);
    }
  }
}

TEST(World, ABadScaleIsAnError) {
  for (const char* scale : {"0", "-1", "1e9", "big", "nan"}) {
    std::string text = map_of(cube_faces());
    text.insert(2, "\"_scale\" \"" + std::string(scale) + "\"\n");
    try {
      build_world(parse(text, "a.map"));
      ADD_FAILURE() << scale;
    } catch (const Error& error) {
      EXPECT_EQ(error.where().line, 2) << error.what();
    }
  }
}

}  // namespace
}  // namespace hallway::map
