// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

#include <fmt/format.h>
#include <png.h>

#include "base/file.hpp"
#include "image/grey_picture.hpp"
#include "image/png.hpp"
#include "solidity.hpp"
#include "world/compiled_world.hpp"

namespace hallway::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// A new map after some lines.
class ShapeCommands : public testing::Test {
 protected:
  ShapeCommands() { editing.run("new"); }

  Box bounds(const std::string& what) const {
    const auto& state = editing.session->state();
    const Box box = editor::bounds_of(state, editor::resolve_one(state, what));
    return {box.min() * 0.01, box.max() * 0.01};
  }

  void expect_bounds(const std::string& what, const Vec3& low, const Vec3& high) const {
    const Box box = bounds(what);
    EXPECT_LT((box.min() - low).norm(), 1e-9) << what << ": " << box.min().transpose();
    EXPECT_LT((box.max() - high).norm(), 1e-9) << what << ": " << box.max().transpose();
  }

  Editing editing;
};

TEST_F(ShapeCommands, ABoxByCornersOrByMiddleAndSize) {
  editing.run("box from 3,2,1 to 1,1,0 name=a");
  expect_bounds("a", {1, 1, 0}, {3, 2, 1});
  editing.run("box at 5,5,0.5 size 2,1,30cm name=b material=wood");
  expect_bounds("b", {4, 4.5, 0.5}, {6, 5.5, 0.8});
  EXPECT_NEAR(volume(editing), 2.6, 1e-9);
  EXPECT_EQ(named(editing, "b").brushes.front().brush->faces.front().material, "wood");
}

TEST_F(ShapeCommands, ABoxWithoutANameIsAPlainBrush) {
  const auto report = editing.run("box 0,0 1,1,1");
  ASSERT_EQ(editing.session->state().entities.size(), 1u);
  EXPECT_EQ(report.data["made"][0], editing.session->state().entities[0]->brushes[0].id);
}

TEST_F(ShapeCommands, BoxRefusals) {
  EXPECT_TRUE(mentions(refusal(editing, "box from 0,0"), "two opposite corners"));
  EXPECT_TRUE(mentions(refusal(editing, "box from 0,0 to 1,1,1 size 1,1,1"), "either"));
  EXPECT_TRUE(mentions(refusal(editing, "box from 0,0 to 1,1"), "X,Y,Z"));
  EXPECT_TRUE(mentions(refusal(editing, "box at 0,0 size 1,1"), "three lengths"));
  EXPECT_TRUE(mentions(refusal(editing, "box from 0,0kg to 1,1,1"), "no place"));
  EXPECT_TRUE(mentions(refusal(editing, "box from=0,0 to=1,1,1 materiel=wood"), "material"));
  editing.run("box 0,0 1,1,1 name=crate");
  EXPECT_TRUE(mentions(refusal(editing, "box 0,0 1,1,1 name=crate"), "has that name already"));
}

/// A cabin in a hall, free-standing or in its corner, has walls and a door; remade, it still has.
TEST_F(ShapeCommands, ARoomInARoomHasWalls) {
  editing.run_all({"room from 0,0 to 10,8 height=3 name=hall", "room from 3,3 to 6,6 height=2.5 name=inner",
                   "room from 0,0 to 2,2 height=2.5 name=corner", "door in inner side=west at 1"});
  for (const double wall : {0.1, 0.2}) {
    SCOPED_TRACE(wall);
    EXPECT_TRUE(is_solid(editing, {3.0 - wall / 2, 5.5, 1}));
    EXPECT_TRUE(is_solid(editing, {4.5, 6.0 + wall / 2, 1}));
    EXPECT_FALSE(is_solid(editing, {4.5, 4.5, 1})) << "its inside";
    EXPECT_FALSE(is_solid(editing, {3.0 - wall / 2, 4.0, 1})) << "its door";
    EXPECT_TRUE(is_solid(editing, {2.05, 1, 1})) << "the room in the corner";
    EXPECT_FALSE(is_solid(editing, {1, 1, 1}));
    EXPECT_FALSE(is_solid(editing, {8, 4, 1})) << "the hall";
    editing.run(fmt::format("remake inner wall={}", 0.2));
  }
  EXPECT_EQ(editing.run("validate").lines, std::vector<std::string>{"nothing is wrong"});
}

TEST_F(ShapeCommands, AWedgeIsHighOnItsSide) {
  for (const std::string side : {"north", "east", "south", "west"}) {
    editing.run("new");
    editing.run("wedge from 0,0 to 2,4,1 high=" + side);
    EXPECT_NEAR(volume(editing), 4.0, 1e-9);
    EXPECT_EQ(is_solid(editing, {1, 3.9, 0.8}), side == "north");
    EXPECT_EQ(is_solid(editing, {1.95, 2, 0.8}), side == "east");
    EXPECT_EQ(is_solid(editing, {1, 0.1, 0.8}), side == "south");
    EXPECT_EQ(is_solid(editing, {0.05, 2, 0.8}), side == "west");
  }
  EXPECT_TRUE(mentions(refusal(editing, "wedge 0,0 1,1,1 high=nort"), "did you mean \"north\""));
  EXPECT_TRUE(mentions(refusal(editing, "wedge 0,0 1,1"), "no volume"));
}

TEST_F(ShapeCommands, ACylinderIsARegularPrismAlongItsAxis) {
  for (const int sides : {3, 4, 16, 61}) {
    for (const std::string axis : {"x", "y", "z"}) {
      editing.run("new");
      editing.run("cylinder at 1,2,3 radius 0.5 height 2 axis=" + axis + " sides=" + std::to_string(sides));
      EXPECT_NEAR(volume(editing), sides / 2.0 * 0.25 * std::sin(2.0 * kPi / sides) * 2.0, 1e-8);
      const int along = axis == "x" ? 0 : axis == "y" ? 1 : 2;
      EXPECT_TRUE(is_solid(editing, Vec3(1, 2, 3) + 1.9 * Vec3::Unit(along)));
      EXPECT_FALSE(is_solid(editing, Vec3(1, 2, 3) - 0.1 * Vec3::Unit(along)));
    }
  }
  EXPECT_TRUE(mentions(refusal(editing, "cylinder at 0,0 radius 1 height 1 sides=2"), "3 to 256"));
  EXPECT_TRUE(mentions(refusal(editing, "cylinder at 0,0 radius 0 height 1"), "not from"));
  EXPECT_TRUE(mentions(refusal(editing, "cylinder at 0,0 radius 1"), "`height`"));
  EXPECT_TRUE(mentions(refusal(editing, "cylinder at 0,0 radius 1 height 1 axis=w"), "not one of"));
}

TEST_F(ShapeCommands, APrismStandsOnItsPolygon) {
  editing.run("prism 0,0;4,0;4,1;1,1;1,3;0,3 height 0.9 z=0.1 name=counter");
  EXPECT_NEAR(volume(editing), 6.0 * 0.9, 1e-9);
  EXPECT_LT(largest_overlap(editing), 1e-12);
  expect_bounds("counter", {0, 0, 0.1}, {4, 3, 1.0});
  EXPECT_TRUE(is_solid(editing, {0.5, 2.5, 0.5}));
  EXPECT_FALSE(is_solid(editing, {2, 2, 0.5}));
  EXPECT_TRUE(mentions(refusal(editing, "prism 0,0;1,1;1,0;0,1 height 1"), "itself"));
  EXPECT_TRUE(mentions(refusal(editing, "prism 0,0;1,1 height 1"), "three corners"));
  EXPECT_TRUE(mentions(refusal(editing, "prism 0,0;1,0;1,1,1 height 1"), "one height"));
  EXPECT_TRUE(mentions(refusal(editing, "prism 0,0;1,0;1,1 height 1kg"), "no length"));
}

TEST_F(ShapeCommands, AWallStandsOnItsLine) {
  editing.run("wall from 1,1,0.5 to 4,5 name=slanted height=3 thickness=20cm");
  EXPECT_NEAR(volume(editing), 5.0 * 3.0 * 0.2, 1e-9);
  const Vec3 along(0.6, 0.8, 0.0), across(-0.8, 0.6, 0.0), from(1, 1, 0.5);
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(is_solid(editing, from + 2.0 * along + side * 0.099 * across + Vec3(0, 0, 2.9)));
    EXPECT_FALSE(is_solid(editing, from + 2.0 * along + side * 0.101 * across + Vec3(0, 0, 2.9)));
  }
  EXPECT_FALSE(is_solid(editing, from + 5.01 * along + Vec3(0, 0, 1)));
  EXPECT_TRUE(mentions(refusal(editing, "wall from 0,0 to 0,0"), "one place"));
  EXPECT_TRUE(mentions(refusal(editing, "wall from 0,0,1 to 3,0,2"), "one height"));
  EXPECT_TRUE(mentions(refusal(editing, "wall from 0,0 to 3,0 thickness=0"), "thickness"));
}

TEST_F(ShapeCommands, WallsWithoutNamesMeetInCornersAndCanBeMadeAgain) {
  editing.run_all({"wall from 0,0 to 4,0 thickness=0.2", "wall from 4,0 to 4,3 thickness=0.2"});
  EXPECT_TRUE(is_solid(editing, {4.09, -0.09, 1}));  // the corner
  EXPECT_FALSE(is_solid(editing, {4.11, -0.09, 1}));
  const auto second = editing.session->state().entities.back()->id;
  editing.run(fmt::format("remake #{} height=1", second));
  EXPECT_TRUE(is_solid(editing, {4, 2, 0.9}));
  EXPECT_FALSE(is_solid(editing, {4, 2, 1.1}));
}

TEST_F(ShapeCommands, WallsThatEndAtOnePlaceFillTheirCorner) {
  editing.run("wall from 0,0 to 6,0 thickness=0.3 name=south");
  editing.run("wall from 6,0 to 6,4 thickness=0.2 name=east");
  for (const double x : {5.91, 6.09}) {
    for (const double y : {-0.14, 0.14}) EXPECT_TRUE(is_solid(editing, Vec3(x, y, 1))) << x << " " << y;
  }
  EXPECT_FALSE(is_solid(editing, Vec3(6.05, -0.16, 1)));
  EXPECT_FALSE(is_solid(editing, Vec3(6, 4.01, 1))) << "nothing ends there";
  EXPECT_FALSE(is_solid(editing, Vec3(-0.01, 0, 1)));
  // A door counts from where the wall begins, not from its corner; and the corner stays when the wall is made again.
  editing.run("door in east at 2 width 1");
  EXPECT_FALSE(is_solid(editing, Vec3(6, 2, 1)));
  EXPECT_TRUE(is_solid(editing, Vec3(6, 1.49, 1)));
  editing.run("remake east height=3");
  EXPECT_TRUE(is_solid(editing, Vec3(6.09, -0.14, 2.9)));
  EXPECT_FALSE(is_solid(editing, Vec3(6, 2, 1)));
  editing.run("wall from 6,0 to 9,0 behind=0.5 before=0 name=open");
  EXPECT_TRUE(is_solid(editing, Vec3(9.49, 0, 1)));
}

TEST_F(ShapeCommands, AnArcsStretchesMeetWithoutGapOrOverlap) {
  struct Case {
    std::string angles;
    double sweep_deg;
    int segments;
  };
  for (const Case& c :
       {Case{"from=0 to=90", 90, 6}, Case{"from=350 to=20", 30, 3}, Case{"from=-45 to=200", 245, 9},
        Case{"from=0 to=360", 360, 12}, Case{"from=30 to=30", 360, 5}}) {
    editing.run("new");
    editing.run("arc centre=2,1 radius=3 " + c.angles + " segments=" + std::to_string(c.segments) +
                " height=2 thickness=0.3 name=bay");
    const double half_step = c.sweep_deg / c.segments / 2.0 * kPi / 180.0;
    EXPECT_EQ(brush_count(editing), static_cast<std::size_t>(c.segments));
    EXPECT_NEAR(volume(editing), c.segments * 2.0 * 3.0 * std::sin(half_step) * 0.3 * 2.0, 1e-8) << c.angles;
    EXPECT_LT(largest_overlap(editing), 1e-12) << c.angles;
    // The joints are solid: the middle line is, all along.
    const map::World world = world_of(editing);
    const double start = std::stod(c.angles.substr(5)) * kPi / 180.0;
    for (int i = 1; i < 300; ++i) {
      const double angle = start + c.sweep_deg * kPi / 180.0 * i / 300.0;
      const double step = 2.0 * half_step;
      const double in_step = std::fmod(angle - start, step) - half_step;
      const double radius = 3.0 * std::cos(half_step) / std::cos(in_step);
      const Vec3 point(2 + radius * std::cos(angle), 1 + radius * std::sin(angle), 1.0);
      const bool solid = std::any_of(world.solids.begin(), world.solids.end(),
                                     [&](const map::Solid& each) { return each.contains(point, -1e-9); });
      EXPECT_TRUE(solid) << c.angles << " at " << i;
    }
  }
}

TEST_F(ShapeCommands, ArcRefusals) {
  EXPECT_TRUE(mentions(refusal(editing, "arc 0,0 radius=3 from=0 to=400"), "one turn"));
  EXPECT_TRUE(mentions(refusal(editing, "arc 0,0 radius=3 from=0 to=300 segments=2"), "more `segments`"));
  EXPECT_TRUE(mentions(refusal(editing, "arc 0,0 radius=0.1 from=0 to=90 thickness=0.3"), "too thick"));
  EXPECT_TRUE(mentions(refusal(editing, "arc 0,0 radius=3 from=north to=90"), "no angle"));
  EXPECT_TRUE(mentions(refusal(editing, "arc 0,0 radius=3 from=0"), "`to`"));
}

TEST_F(ShapeCommands, ARoomIsSealed) {
  editing.run(
      "room from 0,0,1 to 5,4 height=2.5 wall=0.2 floor=0.3 ceiling=0.1 floor_material=wood name=kitchen");
  editing.run("entity hw_robot_start at=1,1,1.2");
  EXPECT_NEAR(volume(editing, "func_group"), 5.4 * 4.4 * 2.9, 1e-9);
  EXPECT_NEAR(volume(editing, "hw_subtract"), 5.0 * 4.0 * 2.5, 1e-9);
  expect_bounds("kitchen", {-0.2, -0.2, 0.7}, {5.2, 4.2, 3.6});
  const auto compiled = world::compile(editor::document_of(editing.session->state(), "map.map"), {});
  EXPECT_TRUE(compiled.sealed());
  EXPECT_TRUE(compiled.brushes.problems.empty());
  // One sees the materials of the cut: the floor is the one whose face looks down, out of the cut.
  for (const map::Solid& solid : compiled.brushes.solids) {
    if (solid.role != map::BrushRole::kSubtract) continue;
    for (const map::SolidFace& face : solid.faces) {
      const double up = face.polygon.plane.normal.z();
      EXPECT_EQ(face.material, up < -0.5 ? "wood" : up > 0.5 ? "ceiling" : "wall");
    }
  }
}

TEST_F(ShapeCommands, RoomRefusals) {
  EXPECT_TRUE(mentions(refusal(editing, "room from 0,0 to 4,0"), "opposite corners"));
  EXPECT_TRUE(mentions(refusal(editing, "room from 0,0 to 4,3 heigth=3"), "did you mean \"height\""));
  EXPECT_TRUE(mentions(refusal(editing, "room from 0,0 to 4,3 wall=-1"), "wall"));
}

TEST_F(ShapeCommands, WhatIsMadeInARoomStaysThere) {
  editing.run("room from 0,0 to 5,4 name=kitchen");
  const auto report = editing.run("box from 1,1 to 2,2,0.7 name=table");
  EXPECT_TRUE(is_solid(editing, {1.5, 1.5, 0.3}));
  EXPECT_EQ(report.data["order"], 2);
  editing.run("box from 3,1 to 4,2,0.7");
  EXPECT_TRUE(is_solid(editing, {3.5, 1.5, 0.3}));
  editing.run("stairs from 0,3.5 to 2,3.5 rise=1 steps=4 name=steps");
  EXPECT_TRUE(is_solid(editing, {1.9, 3.5, 0.9}));
  // Beside the room nothing is cut out.
  const auto beside = editing.run("box from 8,1 to 9,2,0.7");
  EXPECT_EQ(beside.lines.size(), 1u);
  // It says what a room cuts away, and the second room leaves what is in the first.
  const auto second = editing.run("room from 7,0 to 12,4 name=bath");
  EXPECT_TRUE(mentions(second.lines.front(), "cuts away")) << second.lines.front();
  EXPECT_FALSE(is_solid(editing, {8.5, 1.5, 0.3}));
  EXPECT_TRUE(is_solid(editing, {1.5, 1.5, 0.3}));
}

TEST_F(ShapeCommands, StairsRiseStepByStep) {
  editing.run("stairs from 0,0,1 to 3,4 width=1.2 rise=2 steps=10 name=flight");
  EXPECT_EQ(brush_count(editing), 10u);
  EXPECT_NEAR(volume(editing), 5.0 * 1.2 * 2.0 * 11.0 / 20.0, 1e-8);
  EXPECT_LT(largest_overlap(editing), 1e-12);
  const Vec3 along(0.6, 0.8, 0.0);
  for (int i = 0; i < 10; ++i) {
    const Vec3 tread = (0.25 + 0.5 * i) * along + Vec3(0, 0, 1.0 + 0.2 * (i + 1));
    EXPECT_TRUE(is_solid(editing, tread - Vec3(0, 0, 0.001)));
    EXPECT_FALSE(is_solid(editing, tread + Vec3(0, 0, 0.001)));
  }
  EXPECT_TRUE(mentions(refusal(editing, "stairs 0,0 0,0 rise=1 steps=3"), "one place"));
  EXPECT_TRUE(mentions(refusal(editing, "stairs 0,0 1,0 rise=1 steps=1.5"), "whole number"));
  EXPECT_TRUE(mentions(refusal(editing, "stairs 0,0 1,0 rise=1"), "`steps`"));
}

TEST_F(ShapeCommands, ARampIsASlabOrSolid) {
  editing.run("ramp from 0,0,1 to 4,0,1.6 width=1.5");
  EXPECT_NEAR(volume(editing), 4.0 * 1.5 * 0.6 / 2.0, 1e-9);
  EXPECT_TRUE(is_solid(editing, {3, 0.7, 1.44}));
  EXPECT_FALSE(is_solid(editing, {3, 0.7, 1.46}));
  editing.run("new");
  editing.run("ramp from 0,0,2 to 0,4,1 width=1 thickness=0.2");
  EXPECT_NEAR(volume(editing), 4.0 * 0.2, 1e-9);
  EXPECT_TRUE(is_solid(editing, {0, 2, 1.4}));
  EXPECT_FALSE(is_solid(editing, {0, 2, 1.2}));
  EXPECT_TRUE(mentions(refusal(editing, "ramp 0,0 4,0"), "one height"));
  EXPECT_TRUE(mentions(refusal(editing, "ramp 0,0 0,0,3"), "over each other"));
}

TEST_F(ShapeCommands, ATerrainFollowsItsFormula) {
  editing.run(
      "terrain at=1,2,0.5 size=8,6 cells=8 function=\"0.3*sin(x) * cos(y) + 0.1*x\" depth=0.4 name=garden");
  EXPECT_EQ(brush_count(editing), 2u * 8u * 6u);
  EXPECT_LT(largest_overlap(editing), 1e-9);
  const auto height = [](double x, double y) { return 0.3 * std::sin(x) * std::cos(y) + 0.1 * x; };
  double lowest = 1e300, sum = 0.0;
  for (int x = 0; x <= 8; ++x) {
    for (int y = 0; y <= 6; ++y) lowest = std::min(lowest, height(x, y));
  }
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 6; ++y) {
      const double a = height(x, y), b = height(x + 1, y), c = height(x + 1, y + 1), d = height(x, y + 1);
      sum += (a + b + c) / 6.0 + (a + c + d) / 6.0;
    }
  }
  EXPECT_NEAR(volume(editing), sum + 48.0 * (0.4 - lowest), 1e-5);
  const map::World world = world_of(editing);
  for (int x = 1; x < 8; ++x) {
    const double over = height(x, 3) + 0.5;
    EXPECT_TRUE(is_solid(world, {1.0 + x + 1e-4, 5.0 + 2e-4, over - 0.001}));
    EXPECT_FALSE(is_solid(world, {1.0 + x + 1e-4, 5.0 + 2e-4, over + 0.001}));
  }
}

TEST_F(ShapeCommands, ATerrainFollowsAPicture) {
  // Black in the south-west, white in the north-east; the picture's first row is the north.
  const std::vector<std::uint8_t> bytes{128, 128, 128, 255, 255, 255, 0, 0, 0, 128, 128, 128};
  write_file_atomically(
      editing.folder / "heights.png",
      encode_png({.width_px = 2, .height_px = 2, .channels = 3, .bytes = bytes}, PngEffort::kQuick));
  editing.run("terrain at=0,0 size=4,4 cells=4 file=heights.png low=1 high=3 name=hill");
  const map::World world = world_of(editing);
  const auto expect_height = [&](double x, double y, double height, double slack) {
    EXPECT_TRUE(is_solid(world, {x, y, height - slack})) << x << ' ' << y;
    EXPECT_FALSE(is_solid(world, {x, y, height + slack})) << x << ' ' << y;
  };
  expect_height(0.01, 0.005, 1.0, 0.03);
  expect_height(3.99, 3.995, 3.0, 0.03);
  expect_height(2.01, 2.005, 2.0, 0.03);
  expect_height(0.01, 3.99, 2.0, 0.03);
}

TEST_F(ShapeCommands, APictureOfSixteenBitsCountsInFull) {
  for (const double gamma : {0.0, 1.0 / 2.2}) {
    const std::vector<std::uint16_t> rows{100, 100, 30000, 30000};  // native; swapped on writing
    const auto file = editing.folder / "deep.png";
    std::FILE* out = std::fopen(file.c_str(), "wb");
    ASSERT_NE(out, nullptr);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, out);
    png_set_IHDR(png, info, 2, 2, 16, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (gamma > 0.0) png_set_gAMA(png, info, gamma);
    png_write_info(png, info);
    for (std::size_t row = 0; row < 2; ++row) {
      std::vector<png_byte> bytes;
      for (std::size_t i = 0; i < 2; ++i) {
        bytes.push_back(static_cast<png_byte>(rows[2 * row + i] >> 8));
        bytes.push_back(static_cast<png_byte>(rows[2 * row + i] & 255));
      }
      png_write_row(png, bytes.data());
    }
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    std::fclose(out);
    const auto picture = read_grey_png(file);
    ASSERT_EQ(picture.values.size(), 4u);
    EXPECT_NEAR(picture.at(0, 0), 100.0 / 65535.0, 1e-9) << gamma;
    EXPECT_NEAR(picture.at(1, 1), 30000.0 / 65535.0, 1e-9) << gamma;
    EXPECT_NEAR(picture.at(0.3, 0.5), 15050.0 / 65535.0, 1e-9) << gamma;
  }
}

TEST_F(ShapeCommands, TerrainRefusals) {
  EXPECT_TRUE(mentions(refusal(editing, "terrain at=0,0 size=4,4"), "`function` or"));
  EXPECT_TRUE(mentions(refusal(editing, "terrain at=0,0 size=4,4 function=1 file=x.png"), "either"));
  EXPECT_TRUE(mentions(refusal(editing, "terrain at=0,0 size=4,4 function=sinn(x)"), "no formula"));
  EXPECT_TRUE(mentions(refusal(editing, "terrain at=0,0 size=4,4 function=(x"), "no formula"));
  EXPECT_TRUE(mentions(refusal(editing, "terrain at=0,0 size=4,4 function=x,y"), "more than one"));
  EXPECT_TRUE(mentions(refusal(editing, "terrain at=0,0 size=4,4 function=1/(x-2) cells=4"), "finite"));
  EXPECT_TRUE(mentions(refusal(editing, "terrain at=0,0 size=4,4 function=x cells=1000"), "the most"));
  EXPECT_TRUE(mentions(refusal(editing, "terrain at=0,0 size=4,0 function=x"), "two lengths"));
  EXPECT_THROW(editing.run("terrain at=0,0 size=4,4 file=none.png"), Error);
  write_file_atomically(editing.folder / "text.png", "this is no picture");
  EXPECT_THROW(editing.run("terrain at=0,0 size=4,4 file=text.png"), Error);
  // Cut short anywhere and changed anywhere, a picture is read or refused.
  const std::vector<std::uint8_t> grey(12 * 9 * 3, 77);
  const std::string png =
      encode_png({.width_px = 12, .height_px = 9, .channels = 3, .bytes = grey}, PngEffort::kQuick);
  for (std::size_t i = 0; i < png.size(); ++i) {
    std::string changed = png;
    changed[i] = static_cast<char>(changed[i] ^ (1 << (i % 8)));
    for (const std::string& bytes : {png.substr(0, i), changed}) {
      std::ofstream(editing.folder / "bad.png", std::ios::binary) << bytes;
      try {
        read_grey_png(editing.folder / "bad.png");
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kBadInput);
      }
    }
  }
}

TEST_F(ShapeCommands, RemakeKeepsNumberNameAndDoors) {
  editing.run("wall from 0,0 to 6,0 name=north");
  editing.run("door in north at 2 name=way");
  const auto id = named(editing, "north").id;
  const auto brush = named(editing, "north").brushes.front().id;
  const auto door = named(editing, "way").id;
  editing.run("remake north height=3 thickness=0.4 to=0,6");
  EXPECT_EQ(named(editing, "north").id, id);
  EXPECT_EQ(named(editing, "north").brushes.front().id, brush);
  EXPECT_EQ(named(editing, "way").id, door);
  expect_bounds("north", {-0.2, 0, 0}, {0.2, 6, 3});
  expect_bounds("way", {-0.2, 1.55, 0}, {0.2, 2.45, 2.1});
  EXPECT_FALSE(is_solid(editing, {0.15, 2, 1}));
  EXPECT_TRUE(is_solid(editing, {0.15, 3, 1}));
  editing.run("remake way at=5 width=1");
  expect_bounds("way", {-0.2, 4.5, 0}, {0.2, 5.5, 2.1});
  EXPECT_EQ(named(editing, "way").id, door);
  editing.run("remake north name=long");
  EXPECT_EQ(named(editing, "long").id, id);
}

TEST_F(ShapeCommands, RemakeWorksForEveryShape) {
  const std::vector<std::pair<std::string, std::string>> lines{
      {"box 0,0 1,1,1 name=s", "to=2,1,1"},
      {"box at=0,0 size=1,1,1 name=s", "at= size= from=0,0 to=2,2,2"},
      {"wedge 0,0 1,1,1 name=s", "high=east"},
      {"cylinder 0,0 radius=1 height=2 name=s", "sides=5"},
      {"prism 0,0;4,0;4,1;1,1;1,3;0,3 height=0.9 name=s", "polygon=0,0;4,0;4,4;1,1"},
      {"arc 0,0 radius=3 from=0 to=90 name=s", "segments=3"},
      {"room 0,0 4,3 name=s", "height=3"},
      {"stairs 0,0 3,0 rise=1 steps=5 name=s", "steps=3"},
      {"ramp 0,0,0 4,0,1 name=s", "thickness=0.2"},
      {"terrain 0,0 size=4,4 cells=4 function=\"0.1 * x\" name=s", "function=0.2*y"}};
  for (const auto& [line, change] : lines) {
    editing.run("new");
    editing.run(line);
    const double before = volume(editing);
    editing.run("remake s " + change);
    const double changed = volume(editing);
    EXPECT_GT(std::abs(changed - before) + (line.starts_with("wedge") ? 1.0 : 0.0), 1e-3) << line;
    editing.session->undo(1);
    EXPECT_NEAR(volume(editing), before, 1e-9) << line;
    // Made with the change from the start it is the same.
    editing.session->redo(1);
    EXPECT_EQ(named(editing, "s").head->find("_hw_made")->substr(0, 3), line.substr(0, 3));
    EXPECT_LT(line.starts_with("room") ? 0.0 : largest_overlap(editing), 1e-9) << line;
  }
}

TEST_F(ShapeCommands, ARemadeShapeMayMoveIntoARoomAndOut) {
  editing.run("room from 0,0 to 5,4 name=kitchen");
  editing.run("box from 8,1 to 9,2,1 name=table");
  const auto id = named(editing, "table").id;
  editing.run("remake table from=1,1 to=2,2,1");
  EXPECT_TRUE(is_solid(editing, {1.5, 1.5, 0.5}));
  EXPECT_FALSE(is_solid(editing, {8.5, 1.5, 0.5}));
  editing.run("remake table from=8,1 to=9,2,1");
  EXPECT_FALSE(is_solid(editing, {1.5, 1.5, 0.5}));
  EXPECT_TRUE(is_solid(editing, {8.5, 1.5, 0.5}));
  EXPECT_EQ(named(editing, "table").id, id);
}

TEST_F(ShapeCommands, RemakeRefusals) {
  editing.run_all({"wall 0,0 6,0 name=north", "door in north at 5 name=way", "box 0,5 1,6,1",
                   "entity light at=1,1,1 targetname=lamp"});
  EXPECT_TRUE(mentions(refusal(editing, "remake nort height=3"), "did you mean \"north\""));
  EXPECT_TRUE(mentions(refusal(editing, "remake north heigth=3"), "did you mean \"height\""));
  EXPECT_TRUE(mentions(refusal(editing, "remake north height=3kg"), "no length"));
  EXPECT_TRUE(mentions(refusal(editing, "remake north"), "`changes`"));
  EXPECT_TRUE(mentions(refusal(editing, "remake north from="), "`from`"));
  EXPECT_TRUE(mentions(refusal(editing, "remake lamp height=3"), "does not know"));
  EXPECT_TRUE(mentions(refusal(editing, "remake box=0,5,0,1,6,1 height=3"), "shapes with a name"));
  EXPECT_TRUE(mentions(refusal(editing, "remake north+lamp height=3"), "2 things"));
  EXPECT_TRUE(mentions(refusal(editing, "remake way in=north"), "stays in its wall"));
  EXPECT_TRUE(mentions(refusal(editing, "remake way at=5.9"), "6 m long"));
  EXPECT_TRUE(mentions(refusal(editing, "remake north to=4,0"), "way"));  // the door does not fit any more
  EXPECT_TRUE(mentions(refusal(editing, "remake north name=way"), "has that name"));
  editing.run("key north _hw_made=delete");
  EXPECT_TRUE(mentions(refusal(editing, "remake north height=3"), "is no command"));
  editing.run("key north _hw_made=\"delete all\"");
  EXPECT_TRUE(mentions(refusal(editing, "remake north height=3"), "makes a shape"));
}

TEST_F(ShapeCommands, AMovedShapeIsRemadeWhereItIs) {
  editing.run_all({"wall 0,0 6,0 name=north", "door in north at 2 name=way", "move north 1,2"});
  editing.run("remake north height=3");
  expect_bounds("north", {1, 1.925, 0}, {7, 2.075, 3});
  expect_bounds("way", {2.55, 1.925, 0}, {3.45, 2.075, 2.1});
}

TEST_F(ShapeCommands, PlacesAreOnTheGrid) {
  editing.run("grid 0.5");
  editing.run("wall 0.1,0.2 5.9,0.1 name=north");
  expect_bounds("north", {0, -0.075, 0}, {6, 0.075, 2.7});
  editing.run("grid 0.7");
  editing.run("remake north height=3");  // what it had stays where it is
  expect_bounds("north", {0, -0.075, 0}, {6, 0.075, 3});
  editing.run("remake north to=5,0");
  expect_bounds("north", {0, -0.075, 0}, {4.9, 0.075, 3});
}

TEST_F(ShapeCommands, ShapesSurviveSavingAndReopening) {
  editing.run_all({"prism 0,0;4,0;4,1;1,1;1,3;0,3 height=0.9 name=s",
                   "terrain 0,10 size=4,4 cells=4 function=\"0.1 * x\" name=garden", "save"});
  editing.reopen();
  editing.run("remake s height=1.8");
  editing.run("remake garden depth=1");
  expect_bounds("s", {0, 0, 0}, {4, 3, 1.8});
}

}  // namespace
}  // namespace hallway::test
