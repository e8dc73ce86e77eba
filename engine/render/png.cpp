// SPDX-License-Identifier: MIT
#include "render/png.hpp"

#include "image/png.hpp"

namespace hallway::render {

std::string encode_png(const Image& image) {
  check_image_size(image.width_px, image.height_px);
  return hallway::encode_png({.width_px = static_cast<std::uint32_t>(image.width_px),
                              .height_px = static_cast<std::uint32_t>(image.height_px),
                              .channels = 3,
                              .bytes = image.bytes},
                             PngEffort::kShortest);
}

}  // namespace hallway::render
