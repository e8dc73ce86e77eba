// SPDX-License-Identifier: MIT
#pragma once

#include <png.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace hallway::test {

/// Values, row by row, as the bytes of a grey PNG file of 16 bits, by libpng's own simple writer.
inline std::string gray_png(std::uint32_t width_px, std::uint32_t height_px,
                            const std::vector<std::uint16_t>& values) {
  png_image image;
  std::memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  image.width = width_px;
  image.height = height_px;
  image.format = PNG_FORMAT_LINEAR_Y;
  png_alloc_size_t size = 0;
  if (values.size() != std::size_t{width_px} * height_px ||
      png_image_write_to_memory(&image, nullptr, &size, 0, values.data(), 0, nullptr) == 0) {
    throw std::runtime_error("cannot make a PNG file");
  }
  std::string bytes(size, '\0');
  png_image_write_to_memory(&image, bytes.data(), &size, 0, values.data(), 0, nullptr);
  bytes.resize(size);
  return bytes;
}

}  // namespace hallway::test
