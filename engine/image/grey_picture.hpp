// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace hallway {

/// A picture in shades of grey, as numbers.
struct GreyPicture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<double> values{};  ///< 0 black to 1 white; rows from the top

  /// The shade at a place: u from 0 (left) to 1 (right), v from 0 (top) to 1 (bottom), the middles of the outermost pixels; linear
  /// between the pixels.
  double at(double u, double v) const;
};

/// Reads a PNG file; 16 bits a channel count in full, colours as their brightness. Throws Error{kIo} where it cannot be read, and
/// Error{kBadInput} where it is no PNG or larger than 4096 pixels a side.
GreyPicture read_grey_png(const std::filesystem::path& file);

}  // namespace hallway
