// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/colour.hpp"

namespace hallway::render {

/// Longest side of a picture, in pixels.
inline constexpr int kMaxImageSide_px = 16384;
/// Most pixels of a picture.
inline constexpr std::int64_t kMaxImagePixels = 32ll << 20;

/// An opaque picture; rows from top to bottom, three bytes (r, g, b) per pixel, no padding.
struct Image {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> bytes;

  /// The pixel in column `x` from the left and row `y` from the top; both must lie in the image.
  Rgb at(int x, int y) const {
    const std::size_t i =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(x));
    return {bytes[i], bytes[i + 1], bytes[i + 2]};
  }
};

/// Throws Error{kBadInput} unless both sides are at least 1, at most kMaxImageSide_px and their product is at most
/// kMaxImagePixels. Allocates nothing.
void check_image_size(std::int64_t width_px, std::int64_t height_px);

}  // namespace hallway::render
