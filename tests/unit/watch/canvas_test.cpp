// SPDX-License-Identifier: MIT
#include "watch/canvas.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.hpp"

namespace hallway::watch {
namespace {

/// The distance of a point from a segment.
double distance(const Vec2& point, const Vec2& a, const Vec2& b) {
  const Vec2 way = b - a;
  const double share =
      way.squaredNorm() > 0.0 ? std::clamp((point - a).dot(way) / way.squaredNorm(), 0.0, 1.0) : 0.0;
  return (a + share * way - point).norm();
}

class LineDots : public testing::TestWithParam<Dots> {};

// The oracle is the distance to the exact line, which knows no clipping and no steps.
TEST_P(LineDots, AreThoseOnTheExactLine) {
  const Random random(7, stream_id("lines"));
  for (std::uint32_t k = 0; k < 200; ++k) {
    const auto number = [&](std::uint32_t i) { return 120.0 * random.uniform(k, i) - 40.0; };
    const Vec2 a(number(0), number(1)), b(number(2), number(3));
    Canvas canvas(12, 7, GetParam());
    canvas.line(a, b, Role::kWall);
    for (int row = 0; row < canvas.dot_rows(); ++row) {
      for (int column = 0; column < canvas.dot_columns(); ++column) {
        if (!canvas.has_dot(column, row)) continue;
        // The line passes the dot's square, or ends on the far edge beside it.
        EXPECT_LE(distance(Vec2(column + 0.5, row + 0.5), a, b), std::sqrt(0.5) + 0.5)
            << column << "," << row;
      }
    }
    // Along the longer axis no dot is missing: each sample of the line has a dot within one of it.
    for (int i = 0; i <= 1000; ++i) {
      const Vec2 at = a + (b - a) * i / 1000.0;
      const int column = static_cast<int>(std::floor(at.x())), row = static_cast<int>(std::floor(at.y()));
      if (column < 1 || row < 1 || column >= canvas.dot_columns() - 1 || row >= canvas.dot_rows() - 1)
        continue;
      bool near = false;
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) near = near || canvas.has_dot(column + x, row + y);
      }
      EXPECT_TRUE(near) << "line " << k << " at " << at.transpose();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, LineDots, testing::Values(Dots::kBraille, Dots::kBlocks, Dots::kAscii));

TEST(CanvasClip, KeepsWhatIsInsideAndDirection) {
  const Random random(8, stream_id("lines"));
  int kept = 0;
  for (std::uint32_t k = 0; k < 500; ++k) {
    const auto number = [&](std::uint32_t i) { return 60.0 * random.uniform(k, i) - 20.0; };
    const Vec2 a(number(0), number(1)), b(number(2), number(3));
    Vec2 from = a, to = b;
    const bool any = clip(from, to, 20.0, 10.0);
    bool sampled = false;
    for (int i = 0; i <= 400; ++i) {
      const Vec2 at = a + (b - a) * i / 400.0;
      sampled = sampled || (at.x() > 0.0 && at.x() < 20.0 && at.y() > 0.0 && at.y() < 10.0);
    }
    if (sampled) {
      EXPECT_TRUE(any);
    }
    if (!any) continue;
    ++kept;
    for (const Vec2& end : {from, to}) {
      EXPECT_GE(end.x(), -1e-9);
      EXPECT_LE(end.x(), 20.0 + 1e-9);
      EXPECT_GE(end.y(), -1e-9);
      EXPECT_LE(end.y(), 10.0 + 1e-9);
      EXPECT_LE(distance(end, a, b), 1e-9);
    }
    EXPECT_GE((to - from).dot(b - a), -1e-9);
  }
  EXPECT_GT(kept, 50);
}

TEST(Canvas, BrailleDotsAreThoseOfUnicode) {
  // The eight dots, by row and column, one at a time.
  const char32_t glyphs[4][2] = {{U'⠁', U'⠈'}, {U'⠂', U'⠐'}, {U'⠄', U'⠠'}, {U'⡀', U'⢀'}};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 2; ++column) {
      Canvas canvas(1, 1, Dots::kBraille);
      canvas.dot(Vec2(column + 0.5, row + 0.5), Role::kWall);
      Grid grid(1, 1);
      canvas.put(grid, 0, 0);
      EXPECT_EQ(grid.at(0, 0).glyph, glyphs[row][column]) << row << column;
    }
  }
}

TEST(Canvas, QuarterBlocks) {
  Canvas canvas(2, 1, Dots::kBlocks);
  canvas.dot(Vec2(0.5, 0.5), Role::kWall);
  canvas.dot(Vec2(1.5, 1.5), Role::kWall);
  canvas.line(Vec2(2.0, 0.5), Vec2(4.0, 0.5), Role::kWall);
  Grid grid(2, 1);
  canvas.put(grid, 0, 0);
  EXPECT_EQ(grid.row_text(0), "▚▀");
}

TEST(Canvas, AsciiShowsRoles) {
  Canvas canvas(3, 1, Dots::kAscii);
  canvas.dot(Vec2(0.5, 0.5), Role::kWall);
  canvas.dot(Vec2(1.5, 0.5), Role::kRay);
  canvas.glyph(Vec2(2.5, 0.5), U'>', Role::kRobot);
  Grid grid(3, 1);
  canvas.put(grid, 0, 0);
  EXPECT_EQ(grid.row_text(0), "#.>");
}

TEST(Canvas, LaterRoleWinsAndGlyphStaysInFront) {
  Canvas canvas(1, 1, Dots::kBraille);
  canvas.dot(Vec2(0.5, 0.5), Role::kRay);
  canvas.dot(Vec2(0.5, 1.5), Role::kWall);
  Grid grid(1, 1);
  canvas.put(grid, 0, 0);
  EXPECT_EQ(grid.at(0, 0).role, Role::kWall);
  canvas.glyph(Vec2(0.5, 0.5), U'x', Role::kContact);
  canvas.dot(Vec2(0.5, 2.5), Role::kRay);
  canvas.put(grid, 0, 0);
  EXPECT_EQ(grid.at(0, 0), (Cell{U'x', Role::kContact}));
}

TEST(Canvas, NothingOutsideAndNothingInfinite) {
  Canvas canvas(4, 3, Dots::kBraille);
  canvas.dot(Vec2(-0.1, 2.0), Role::kWall);
  canvas.dot(Vec2(8.0, 2.0), Role::kWall);
  canvas.glyph(Vec2(2.0, 12.0), U'x', Role::kWall);
  canvas.line(Vec2(-5.0, -5.0), Vec2(-1.0, 40.0), Role::kWall);
  canvas.line(Vec2(0.0, 0.0), Vec2(std::numeric_limits<double>::infinity(), 1.0), Role::kWall);
  canvas.line(Vec2(std::nan(""), 0.0), Vec2(3.0, 1.0), Role::kWall);
  Grid grid(4, 3);
  canvas.put(grid, 0, 0);
  for (int row = 0; row < 3; ++row) EXPECT_EQ(grid.row_text(row), "");
}

TEST(Canvas, LongLineThroughIsDrawnAtOnce) {
  Canvas canvas(4, 1, Dots::kAscii);
  canvas.line(Vec2(-1e12, 0.5), Vec2(1e12, 0.5), Role::kWall);
  Grid grid(4, 1);
  canvas.put(grid, 0, 0);
  EXPECT_EQ(grid.row_text(0), "####");
}

TEST(Dots, NamesAreReadBack) {
  for (const Dots dots : {Dots::kBraille, Dots::kBlocks, Dots::kAscii})
    EXPECT_EQ(dots_named(name_of(dots)), dots);
  EXPECT_FALSE(dots_named("sixel"));
}

TEST(GridText, IsCutMarkedAndKeptToOneColumn) {
  Grid grid(10, 2);
  grid.put(0, 0, "abcdefgh", Role::kText, 5);
  EXPECT_EQ(grid.row_text(0), "abcd~");
  grid.put(0, 1, "é日\x1b\xff", Role::kText, 10);
  EXPECT_EQ(grid.row_text(1), "é???");
  grid.put(8, 0, "xyz", Role::kText, 10);  // beyond the edge
  EXPECT_EQ(grid.row_text(0), "abcd~   xy");
}

TEST(GridText, Utf8RoundTrip) {
  for (const char32_t glyph : {U'a', U'é', U'→', U'⣿'})
    EXPECT_EQ(glyphs_of(utf8_of(glyph)), std::u32string(1, glyph));
  EXPECT_EQ(utf8_of(U'\U0001f916'), "\xf0\x9f\xa4\x96");
}

}  // namespace
}  // namespace hallway::watch
