// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "render/camera.hpp"
#include "render/canvas.hpp"
#include "render/font.hpp"
#include "render/picture.hpp"

namespace hallway::render {

/// The two fonts of a picture.
struct Fonts {
  Font regular{Font::Weight::kRegular};
  Font bold{Font::Weight::kBold};
};

/// One line of the legend and where it stands.
struct LegendEntry {
  enum class Kind { kLine, kDashedLine, kThinLine, kMark, kField, kArea, kScale };
  Kind kind = Kind::kLine;
  Rgb colour{};
  double width_px = 2.0;  ///< of a line
  double size_px = 5.0;   ///< of a mark
  MarkerShape shape = MarkerShape::kDot;
  std::string text{};
  double opacity = 1.0;        ///< of an area
  std::vector<Rgb> colours{};  ///< of a scale, from left to right
  Vec2 at_px = Vec2::Zero();   ///< left end, middle of the line's height
};

/// How a picture is divided: title above, map area, scale bar and legend below. Pictures too small for texts are all map.
struct Layout {
  bool furniture = false;  ///< whether there is room for title, legend and scale bar
  double unit = 1.0;       ///< pixels per pixel of a picture of the usual size, 1280 x 800
  PixelRect map;
  double text_px = 13.0;
  std::vector<LegendEntry> legend;
};

/// Divides a picture. Texts are echoed safely and shortened to fit.
Layout make_layout(const Picture& picture, int width_px, int height_px, const Fonts& fonts);

/// A scale bar: the largest of 1, 2, 5, 10, ... metres (or parts of a metre) not longer than `most_px`.
struct ScaleBar {
  double metres = 1.0;
  double length_px = 0.0;
};
ScaleBar scale_bar(double pixels_per_metre, double most_px);

/// The largest of 1, 2 and 5 times a power of ten that is not above `value` (positive and finite).
double round_down_125(double value);

/// "5 m", "20 cm", "2 km".
std::string length_text(double metres);

/// Paints title, frame, axes, legend and scale bar (in perspective with `grid_m` > 0: the width of the grid instead).
void paint_furniture(Canvas& canvas, const Picture& picture, const Layout& layout, const Camera& camera,
                     int width_px, int height_px, double grid_m, const Fonts& fonts);

}  // namespace hallway::render
