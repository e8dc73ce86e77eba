// SPDX-License-Identifier: MIT
#include "render/image.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace hallway::render {

void paste(const Image& from, int x, int y, Image& to) {
  for_each_pixel({0, 0, from.width_px, from.height_px},
                 [&](int column, int row) { to.set(x + column, y + row, from.at(column, row)); });
}

void check_image_size(std::int64_t width_px, std::int64_t height_px) {
  const auto side_ok = [](std::int64_t side) { return side >= 1 && side <= kMaxImageSide_px; };
  if (side_ok(width_px) && side_ok(height_px) && width_px * height_px <= kMaxImagePixels) return;
  throw Error(
      ErrorCode::kBadInput,
      fmt::format(
          "a picture of {}x{} pixels cannot be drawn: each side must be 1 to {} and the whole at most "
          "{} pixels",
          width_px, height_px, kMaxImageSide_px, kMaxImagePixels));
}

Image blank_image(int width_px, int height_px, Rgb colour) {
  Image image{width_px, height_px, {}};
  image.bytes.resize(3 * pixel_index(0, height_px, width_px));
  for_each_pixel({0, 0, width_px, height_px}, [&](int x, int y) { image.set(x, y, colour); });
  return image;
}

}  // namespace hallway::render
