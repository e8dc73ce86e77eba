// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "geometry/se3.hpp"
#include "watch/grid.hpp"

namespace hallway::watch {

/// What dots are made of.
enum class Dots {
  kBraille,  ///< 2 x 4 in a cell
  kBlocks,   ///< 2 x 2 in a cell, quarter blocks
  kAscii,    ///< 1 in a cell, where a terminal has no other characters
};

/// Dots in a cell, across and down.
struct DotShape {
  int columns = 1;
  int rows = 1;
};
DotShape shape_of(Dots dots);

/// The kind of that name (`braille`, `blocks`, `ascii`); nothing for another one.
std::optional<Dots> dots_named(std::string_view name);
std::string_view name_of(Dots dots);

/// A drawing of dots. Places are in dots from the upper left corner of the first one, x to the right and y down; dot (i, j) is where i <= x < i + 1 and
/// j <= y < j + 1. A cell has the role of what was drawn in it last. What is outside is left out.
class Canvas {
 public:
  /// @param width, height  in cells
  Canvas(int width, int height, Dots dots);

  int dot_columns() const { return width_ * shape_.columns; }
  int dot_rows() const { return height_ * shape_.rows; }

  void dot(const Vec2& place, Role role);
  /// All dots on a line, clipped first. O(dots). An end that is not finite draws nothing.
  /// @param every  draws each n-th dot alone
  void line(const Vec2& from, const Vec2& to, Role role, int every = 1);
  /// A character in the cell of a place; in front of all dots.
  void glyph(const Vec2& place, char32_t glyph, Role role);
  /// Whether a dot is set.
  bool has_dot(int column, int row) const;

  /// Puts the drawing into a page, with its upper left cell at a place. Cells without anything stay as they are.
  void put(Grid& grid, int column, int row) const;

 private:
  struct DotCell {
    std::uint8_t bits = 0;  ///< row by row, from the upper left dot
    char32_t glyph = 0;     ///< 0: none
    Role role = Role::kText;
  };
  bool holds(const Vec2& place) const;
  DotCell& cell_at(int dot_column, int dot_row);
  void set(int dot_column, int dot_row, Role role);
  char32_t glyph_of(const DotCell& cell) const;

  int width_;
  int height_;
  Dots dots_;
  DotShape shape_;
  std::vector<DotCell> cells_;
};

/// The part of a line within 0 <= x <= width, 0 <= y <= height; false where there is none (Liang and Barsky, 1984).
bool clip(Vec2& from, Vec2& to, double width, double height);

}  // namespace hallway::watch
