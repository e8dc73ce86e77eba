// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "geometry/se3.hpp"
#include "render/colour.hpp"
#include "study/chart.hpp"
#include "study/ticks.hpp"

namespace hallway::study {

/// A line through points, in pixels from the top left corner.
struct SheetLine {
  std::vector<Vec2> points{};
  render::Rgb colour{};
  double width_px = 1.0;
  bool dashed = false;
  bool clipped = false;  ///< to the frame
};

/// Dots.
struct SheetDots {
  std::vector<Vec2> places{};
  render::Rgb colour{};
  double size_px = 5.0;
};

/// A text on its base line.
struct SheetWords {
  enum class Anchor { kStart, kMiddle, kEnd };
  Vec2 at = Vec2::Zero();
  std::string text{};
  double size_px = 13.0;
  Anchor anchor = Anchor::kStart;
  bool bold = false;
  render::Rgb colour{};
};

using SheetPiece = std::variant<SheetLine, SheetDots, SheetWords>;

/// A chart as what is painted, from back to front. Both forms of a chart are made of it.
struct ChartSheet {
  Vec2 frame_low = Vec2::Zero();   ///< top left corner of the frame
  Vec2 frame_high = Vec2::Zero();  ///< bottom right corner
  AxisRange x{};
  AxisRange y{};
  std::vector<SheetPiece> pieces{};
};

/// Where everything of a chart stands.
ChartSheet lay_out(const Chart& chart);

}  // namespace hallway::study
