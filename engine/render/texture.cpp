// SPDX-License-Identifier: MIT
#include "render/texture.hpp"

#include <algorithm>
#include <array>

namespace hallway::render {
namespace {

/// The texels of a row or column that become the one at `index`.
struct Span {
  std::size_t first, last;
};

Span covered(std::uint64_t index, std::uint64_t from, std::uint64_t to) {
  return {static_cast<std::size_t>(index * from / to), static_cast<std::size_t>((index + 1) * from / to)};
}

}  // namespace

Texture reduced(const Texture& texture, std::uint32_t longest_side) {
  Texture out{std::min(texture.width, longest_side), std::min(texture.height, longest_side), {}};
  out.rgba.reserve(std::size_t{4} * out.width * out.height);
  for (std::uint32_t y = 0; y < out.height; ++y) {
    const Span rows = covered(y, texture.height, out.height);
    for (std::uint32_t x = 0; x < out.width; ++x) {
      const Span columns = covered(x, texture.width, out.width);
      std::array<std::uint64_t, 4> sum{};
      for (std::size_t row = rows.first; row < rows.last; ++row) {
        for (std::size_t column = columns.first; column < columns.last; ++column) {
          const std::size_t texel = 4 * (row * texture.width + column);
          for (std::size_t c = 0; c < 4; ++c) sum[c] += texture.rgba[texel + c];
        }
      }
      const std::uint64_t count = (rows.last - rows.first) * (columns.last - columns.first);
      for (const std::uint64_t channel : sum)
        out.rgba.push_back(static_cast<std::uint8_t>((channel + count / 2) / count));
    }
  }
  return out;
}

}  // namespace hallway::render
