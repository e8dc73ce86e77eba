// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::editor {

struct SheetColour {
  std::uint8_t r = 0, g = 0, b = 0;
};

/// How a line is drawn.
struct Pen {
  SheetColour colour{};
  double width_mm = 0.25;
  double dash_mm = 0.0;  ///< 0: not dashed
  double gap_mm = 0.0;
};

/// An open line through points.
struct SheetLine {
  std::vector<Vec2> points{};
  Pen pen{};
};

/// The inside of closed loops by the even-odd rule.
struct SheetFill {
  std::vector<std::vector<Vec2>> loops{};
  SheetColour colour{};
};

/// A text on one line, in Helvetica or what stands in for it.
struct SheetText {
  enum class Anchor { kStart, kMiddle, kEnd };
  Vec2 at = Vec2::Zero();  ///< on the base line
  std::string text{};      ///< UTF-8, from anywhere
  double size_mm = 2.5;
  Anchor anchor = Anchor::kStart;
  bool upwards = false;  ///< runs from below to above
  SheetColour colour{};
};

/// What is drawn together, in order; the later covers the earlier.
struct SheetLayer {
  std::string name{};  ///< letters and dashes
  std::vector<std::variant<SheetLine, SheetFill, SheetText>> items{};
};

/// A page to be printed: millimetres from its lower left corner, y up.
struct Sheet {
  double width_mm = 210.0;
  double height_mm = 297.0;
  std::string title{};
  std::vector<SheetLayer> layers{};
};

/// How wide a text is in Helvetica; characters beyond ASCII count as a digit.
double text_width_mm(std::string_view utf8, double size_mm);

/// The page as SVG 1.1 at its size, a user unit being a millimetre, y down. A layer is a group of that class. The same sheet gives the
/// same bytes; foreign text is only ever text.
std::string to_svg(const Sheet& sheet);

/// The page as PDF 1.4, uncompressed, ASCII. Characters that are not in Latin-1 become `?`. The same sheet gives the same bytes.
std::string to_pdf(const Sheet& sheet);

/// A number with at most six decimals, without an exponent.
std::string sheet_number(double value);

/// The characters of a text, what is no UTF-8 as U+FFFD.
std::vector<std::uint32_t> code_points(std::string_view utf8);

}  // namespace hallway::editor
