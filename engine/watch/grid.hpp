// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hallway::watch {

/// What a cell shows, from which a terminal chooses a colour.
enum class Role : std::uint8_t {
  kText,
  kDim,       ///< of less weight
  kTitle,     ///< title and help line, reversed
  kWall,      ///< the plan
  kRay,       ///< beams
  kSeen,      ///< what a sensor saw
  kTruth,     ///< where the robot was
  kEstimate,  ///< what a plugin believes
  kContact,   ///< contacts, and lines that warn
  kLandmark,  ///< true landmarks
  kMapped,    ///< what a plugin mapped
  kDrawn,     ///< what a plugin draws
  kRobot,     ///< in front of everything
};

/// A character of a terminal.
struct Cell {
  char32_t glyph = U' ';
  Role role = Role::kText;

  bool operator==(const Cell&) const = default;
};

/// What a terminal shows: cells by row and column, from the upper left corner. What is put beside it is left out.
class Grid {
 public:
  /// All blank. Sizes are at least 1.
  Grid(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  const Cell& at(int column, int row) const { return cells_[index_of(column, row)]; }
  void put(int column, int row, Cell cell);
  /// UTF-8, one character a cell; what is no character of one column is `?`. What is longer than `width` cells ends with `~`.
  void put(int column, int row, std::string_view text, Role role, int width);
  /// Blanks of a role from a column to the end of the row.
  void fill(int column, int row, Role role);
  /// The characters of a row as UTF-8, without blanks at the end.
  std::string row_text(int row) const;

 private:
  std::size_t index_of(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(column);
  }

  int width_;
  int height_;
  std::vector<Cell> cells_;
};

/// A character as UTF-8.
std::string utf8_of(char32_t glyph);

/// The characters of UTF-8 text, as Grid::put() shows them.
std::u32string glyphs_of(std::string_view text);

}  // namespace hallway::watch
