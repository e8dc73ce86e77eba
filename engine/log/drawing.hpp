// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hallway::log {

/// What an item of a drawing is.
enum class DrawingKind { kPolyline, kCircle, kText };

/// The kind's name in files: "polyline", "circle" or "text".
std::string_view drawing_kind_name(DrawingKind kind);

/// What an item of a drawing is of, in the order of HW_COLOUR_….
enum class DrawingColour { kPlain, kFaint, kSensed, kFollowed, kPlanned, kLandmark, kWarning, kHighlight };

/// The colour's name in files: "plain", "faint", "sensed", ….
std::string_view drawing_colour_name(DrawingColour colour);

/// A line, a circle or a text that a plugin shows at a frame.
struct DrawingItem {
  DrawingKind kind = DrawingKind::kPolyline;
  DrawingColour colour = DrawingColour::kPlain;
  bool closed = false;                            ///< of a polyline
  double radius_m = 0;                            ///< of a circle, above 0
  std::vector<std::array<double, 2>> points_m{};  ///< body; two or more of a polyline, else one
  std::string text{};                             ///< of a text, UTF-8

  friend bool operator==(const DrawingItem&, const DrawingItem&) = default;
};

/// All that a plugin shows at a frame.
using Drawing = std::vector<DrawingItem>;

}  // namespace hallway::log
