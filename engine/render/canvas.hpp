// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "render/camera.hpp"
#include "render/font.hpp"
#include "render/image.hpp"
#include "render/picture.hpp"

namespace hallway::render {

/// What hides lines and markers: for each pixel of `area` the distance of the nearest face, infinity for none.
struct Occluders {
  PixelRect area;
  std::vector<float> distance_m;

  /// True if something at this place and distance is behind a face by more than the picture can resolve.
  bool hides(int x, int y, double distance) const;
};

/// A straight line in the picture.
struct ScreenSegment {
  ScreenPoint from, to;
};

struct StrokeStyle {
  Rgb colour;
  double width_px = 1.0;
  double opacity = 1.0;
  double halo_px =
      0.0;  ///< width of a rim in the paper's colour that sets the line off from what lies under it
};

/// Paints lines, marks and texts, anti-aliased by exact distances, into an image within a clip rectangle.
class Canvas {
 public:
  explicit Canvas(Image& image);

  /// Restricts painting to a rectangle.
  void set_clip(const PixelRect& clip);
  /// What hides from now on; null for nothing. Hidden parts of lines and marks are painted faintly. Not owned.
  void set_occluders(const Occluders* occluders) { occluders_ = occluders; }

  /// Paints segments as one layer: where they cross or join, they do not add up. Ends are round.
  void stroke(std::span<const ScreenSegment> segments, const StrokeStyle& style);
  /// Paints the inside of a convex polygon, faintly where it is hidden. Its corners lie in one plane of the world.
  void fill_convex(std::span<const ScreenPoint> corners, Rgb colour, double opacity);
  /// Paints one mark of the given diameter.
  void mark(const ScreenPoint& at, MarkerShape shape, Rgb colour, double size_px);
  /// Paints a text from its origin on the base line, with a rim in the paper's colour.
  void text(const Font& font, std::string_view utf8, double size_px, const Vec2& origin_px, Rgb colour);

 private:
  void blend(int x, int y, Rgb colour, double opacity);
  void cover(const ScreenSegment& segment, double radius_px);
  void composite(Rgb colour, double opacity, double hidden_share, const PixelRect& touched);
  void stroke_layer(std::span<const ScreenSegment> segments, const StrokeStyle& style, double hidden_share);

  Image& image_;
  PixelRect clip_;
  const Occluders* occluders_ = nullptr;
  std::vector<float> visible_;  // coverage of the layer being painted; all zero between layers
  std::vector<float> hidden_;
};

}  // namespace hallway::render
