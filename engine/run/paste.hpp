// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "render/image.hpp"

namespace hallway::run {

/// Copies an image into a larger one, its top left corner at column `x` and row `y`.
inline void paste(const render::Image& from, int x, int y, render::Image& to) {
  const auto stride = [](const render::Image& image) {
    return 3 * static_cast<std::ptrdiff_t>(image.width_px);
  };
  for (int row = 0; row < from.height_px; ++row) {
    const auto begin = from.bytes.begin() + row * stride(from);
    std::copy(begin, begin + stride(from), to.bytes.begin() + (y + row) * stride(to) + 3 * x);
  }
}

}  // namespace hallway::run
