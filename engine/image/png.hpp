// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hallway {

/// A picture as plain bytes: rows from top to bottom, no padding, 8 bits a channel, sRGB.
struct Pixels {
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  std::uint32_t channels = 3;             ///< 3: red, green, blue; 4: and alpha
  std::span<const std::uint8_t> bytes{};  ///< channels * width_px * height_px of them
};

/// How long the writer looks for a short file.
enum class PngEffort { kQuick, kShortest };

/// The picture as the bytes of a PNG file, without loss; the same picture gives the same bytes (no time stamp, no text).
/// Throws Error{kBadInput} if the picture has no pixels, or its size and its bytes do not agree.
std::string encode_png(const Pixels& pixels, PngEffort effort);

/// A picture of one number for each pixel, rows from top to bottom, such as a depth image.
struct Gray16 {
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  std::vector<std::uint16_t> values{};  ///< width_px * height_px of them
};

/// The values of a PNG file of kind grey, 16 bits, as they stand (no gamma). Throws Error{kBadInput} for other bytes and other kinds, for one that is
/// damaged or cut off, and, before memory is taken for them, for more than `max_pixels` pixels.
Gray16 decode_gray16(std::string_view png, std::uint64_t max_pixels);

}  // namespace hallway
