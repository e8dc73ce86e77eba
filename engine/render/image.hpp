// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/colour.hpp"

namespace hallway::render {

/// Longest side of a picture, in pixels.
inline constexpr int kMaxImageSide_px = 16384;
/// Most pixels of a picture.
inline constexpr std::int64_t kMaxImagePixels = 32ll << 20;

/// A rectangle in pixels, edges inclusive on the left and top, exclusive on the right and bottom.
struct PixelRect {
  int left = 0, top = 0, right = 0, bottom = 0;
  int width() const { return right - left; }
  int height() const { return bottom - top; }
};

/// Calls `visit(x, y)` for each pixel of a rectangle, row after row.
template <typename Visit>
void for_each_pixel(const PixelRect& area, Visit visit) {
  for (int y = area.top; y < area.bottom; ++y) {
    for (int x = area.left; x < area.right; ++x) visit(x, y);
  }
}

/// The place of column `x` of row `y` in rows of a width.
constexpr std::size_t pixel_index(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

/// An opaque picture; rows from top to bottom, three bytes (r, g, b) per pixel, no padding.
struct Image {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> bytes;

  /// The pixel in column `x` from the left and row `y` from the top; both must lie in the image.
  Rgb at(int x, int y) const {
    const std::uint8_t* c = &bytes[3 * pixel_index(x, y, width_px)];
    return {c[0], c[1], c[2]};
  }
  void set(int x, int y, Rgb colour) {
    const std::array<std::uint8_t, 3> c{colour.r, colour.g, colour.b};
    std::copy(c.begin(), c.end(), &bytes[3 * pixel_index(x, y, width_px)]);
  }
};

/// A picture of one colour.
Image blank_image(int width_px, int height_px, Rgb colour = palette::kPaper);

/// Copies an image into a larger one, its top left corner at column `x` and row `y`.
void paste(const Image& from, int x, int y, Image& to);

/// Throws Error{kBadInput} unless both sides are at least 1, at most kMaxImageSide_px and their product is at most
/// kMaxImagePixels. Allocates nothing.
void check_image_size(std::int64_t width_px, std::int64_t height_px);

}  // namespace hallway::render
