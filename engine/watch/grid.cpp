// SPDX-License-Identifier: MIT
#include "watch/grid.hpp"

#include <algorithm>

namespace hallway::watch {
namespace {

/// Whether a terminal surely gives it one column: Latin, Greek and Cyrillic letters, arrows, boxes, blocks and braille.
bool has_one_column(char32_t glyph) {
  return (glyph >= 0x20 && glyph < 0x7f) || (glyph >= 0xa1 && glyph < 0x300 && glyph != 0xad) ||
         (glyph >= 0x370 && glyph < 0x483) || (glyph >= 0x2010 && glyph < 0x2028) ||
         (glyph >= 0x2190 && glyph < 0x2300) || (glyph >= 0x2500 && glyph < 0x25fd) ||
         (glyph >= 0x2800 && glyph < 0x2900);
}

/// How many bytes a character takes, by its first one; 0 for a byte that begins none.
int length_of(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  if (first >= 0xf0 && first < 0xf5) return 4;
  return 0;
}

}  // namespace

std::string utf8_of(char32_t glyph) {
  std::string text;
  const auto add = [&](char32_t bits) { text += static_cast<char>(bits); };
  if (glyph < 0x80) {
    add(glyph);
  } else if (glyph < 0x800) {
    add(0xc0 | (glyph >> 6));
    add(0x80 | (glyph & 0x3f));
  } else if (glyph < 0x10000) {
    add(0xe0 | (glyph >> 12));
    add(0x80 | ((glyph >> 6) & 0x3f));
    add(0x80 | (glyph & 0x3f));
  } else {
    add(0xf0 | (glyph >> 18));
    add(0x80 | ((glyph >> 12) & 0x3f));
    add(0x80 | ((glyph >> 6) & 0x3f));
    add(0x80 | (glyph & 0x3f));
  }
  return text;
}

std::u32string glyphs_of(std::string_view text) {
  std::u32string glyphs;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const int length = length_of(first);
    char32_t glyph = length < 2 ? first : first & (0x7fu >> length);
    int k = 1;
    for (; k < length && i + static_cast<std::size_t>(k) < text.size(); ++k) {
      const auto next = static_cast<unsigned char>(text[i + static_cast<std::size_t>(k)]);
      if ((next & 0xc0) != 0x80) break;
      glyph = (glyph << 6) | (next & 0x3f);
    }
    const bool whole = length > 0 && k == length;
    glyphs += whole && has_one_column(glyph) ? glyph : U'?';
    i += static_cast<std::size_t>(k);
  }
  return glyphs;
}

Grid::Grid(int width, int height)
    : width_(std::max(width, 1)),
      height_(std::max(height, 1)),
      cells_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {}

void Grid::put(int column, int row, Cell cell) {
  if (column < 0 || row < 0 || column >= width_ || row >= height_) return;
  cells_[index_of(column, row)] = cell;
}

void Grid::put(int column, int row, std::string_view text, Role role, int width) {
  std::u32string glyphs = glyphs_of(text);
  const auto room = static_cast<std::size_t>(std::max(width, 0));
  if (glyphs.size() > room) {
    glyphs.resize(room);
    if (room > 0) glyphs.back() = U'~';
  }
  for (const char32_t glyph : glyphs) put(column++, row, Cell{glyph, role});
}

void Grid::fill(int column, int row, Role role) {
  for (int k = std::max(column, 0); k < width_; ++k) put(k, row, Cell{U' ', role});
}

std::string Grid::row_text(int row) const {
  std::string text;
  for (int column = 0; column < width_; ++column) text += utf8_of(at(column, row).glyph);
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

}  // namespace hallway::watch
