// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace hallway::render {

/// A picture on faces: rows from top to bottom, four bytes (red, green, blue: sRGB; alpha) a texel. It repeats beyond its
/// edges. Where alpha is below one half there is a hole, elsewhere it is opaque.
struct Texture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba{};  ///< 4 * width * height bytes

  /// Whether it has texels, and as many as it says.
  bool whole() const {
    return width > 0 && height > 0 && rgba.size() / 4 / width == height &&
           rgba.size() % (std::uint64_t{4} * width) == 0;
  }
};

/// The texture with no side longer than that (at least 1): each texel is the mean of those that it covers. O(texels).
Texture reduced(const Texture& texture, std::uint32_t longest_side);

}  // namespace hallway::render
