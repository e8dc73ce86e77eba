// SPDX-License-Identifier: MIT
#include "render/font.hpp"

#include <stb/stb_truetype.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/file.hpp"
#include "render/image.hpp"

namespace hallway::render {
namespace {

constexpr std::uint64_t kMaxFontBytes = 16u << 20;
constexpr std::uint32_t kReplacement = 0xFFFD;
constexpr std::string_view kEllipsis = "\xE2\x80\xA6";

/// The code point that begins at `i`; moves `i` behind it.
std::uint32_t next_code_point(std::string_view text, std::size_t& i) {
  const auto byte = [&](std::size_t k) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(text[k]));
  };
  const std::uint32_t first = byte(i++);
  if (first < 0x80) return first;
  const std::size_t more = first >= 0xF0 && first < 0xF8   ? 3
                           : first >= 0xE0 && first < 0xF0 ? 2
                           : first >= 0xC2 && first < 0xE0 ? 1
                                                           : 0;
  if (more == 0 || i + more > text.size()) return kReplacement;
  std::uint32_t code = first & (0x3Fu >> more);
  for (std::size_t k = 0; k < more; ++k) {
    if ((byte(i + k) & 0xC0u) != 0x80u) return kReplacement;
    code = (code << 6) | (byte(i + k) & 0x3Fu);
  }
  i += more;
  return code;
}

/// Where each code point of `text` begins.
std::vector<std::size_t> code_point_starts(std::string_view text) {
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < text.size();) {
    starts.push_back(i);
    next_code_point(text, i);
  }
  return starts;
}

}  // namespace

struct Font::Data {
  std::string file;
  stbtt_fontinfo info{};

  float scale(double size_px) const {
    return stbtt_ScaleForMappingEmToPixels(&info, static_cast<float>(size_px));
  }

  /// Calls `visit(glyph, x)` for each glyph with its origin in pixels; returns the text's advance.
  template <class Visit>
  double walk(std::string_view text, double size_px, Visit&& visit) const {
    const double unit = static_cast<double>(scale(size_px));
    double x = 0.0;
    int previous = 0;
    for (std::size_t i = 0; i < text.size();) {
      const int glyph = stbtt_FindGlyphIndex(&info, static_cast<int>(next_code_point(text, i)));
      if (previous != 0) x += unit * stbtt_GetGlyphKernAdvance(&info, previous, glyph);
      visit(glyph, x);
      int advance = 0;
      int bearing = 0;
      stbtt_GetGlyphHMetrics(&info, glyph, &advance, &bearing);
      x += unit * advance;
      previous = glyph;
    }
    return x;
  }
};

Font::Font(Weight weight) : data_(std::make_unique<Data>()) {
  const char* path = weight == Weight::kBold ? HALLWAY_FONT_BOLD : HALLWAY_FONT_REGULAR;
  data_->file = read_file(path, kMaxFontBytes);
  const auto* bytes = reinterpret_cast<const unsigned char*>(data_->file.data());
  const int offset = data_->file.size() < 12 ? -1 : stbtt_GetFontOffsetForIndex(bytes, 0);
  if (offset < 0 || stbtt_InitFont(&data_->info, bytes, offset) == 0) {
    throw Error(ErrorCode::kIo, "not a TrueType font (package fonts-dejavu-core)", {path, 0, ""});
  }
}

Font::Font(Font&&) noexcept = default;
Font& Font::operator=(Font&&) noexcept = default;
Font::~Font() = default;

double Font::width_px(std::string_view text, double size_px) const {
  return data_->walk(text, size_px, [](int, double) {});
}

std::string Font::shortened(std::string_view text, double size_px, double most_px) const {
  if (width_px(text, size_px) <= most_px) return std::string(text);
  const std::vector<std::size_t> starts = code_point_starts(text);
  for (std::size_t keep = starts.size(); keep-- > 1;) {
    std::string part(text.substr(0, starts[keep]));
    part += kEllipsis;
    if (width_px(part, size_px) <= most_px) return part;
  }
  return {};
}

TextBitmap Font::render(std::string_view text, double size_px) const {
  const float unit = data_->scale(size_px);
  TextBitmap out;
  int right = 0;
  int bottom = 0;
  const auto box_of = [&](int glyph, double x, int& x0, int& y0, int& x1, int& y1) {
    const float part = static_cast<float>(x - std::floor(x));
    stbtt_GetGlyphBitmapBoxSubpixel(&data_->info, glyph, unit, unit, part, 0.0f, &x0, &y0, &x1, &y1);
    const int column = static_cast<int>(std::floor(x));
    x0 += column;
    x1 += column;
    return part;
  };
  data_->walk(text, size_px, [&](int glyph, double x) {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    box_of(glyph, x, x0, y0, x1, y1);
    out.left = std::min(out.left, x0);
    out.top = std::min(out.top, y0);
    right = std::max(right, x1);
    bottom = std::max(bottom, y1);
  });
  out.width = right - out.left;
  out.height = bottom - out.top;
  out.coverage.assign(pixel_index(0, out.height, out.width), 0);
  std::vector<std::uint8_t> glyph_pixels;
  data_->walk(text, size_px, [&](int glyph, double x) {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    const float part = box_of(glyph, x, x0, y0, x1, y1);
    const int width = x1 - x0;
    const int height = y1 - y0;
    if (width <= 0 || height <= 0) return;
    glyph_pixels.assign(pixel_index(0, height, width), 0);
    stbtt_MakeGlyphBitmapSubpixel(&data_->info, glyph_pixels.data(), width, height, width, unit, unit, part,
                                  0.0f, glyph);
    for_each_pixel({0, 0, width, height}, [&](int column, int row) {
      std::uint8_t& to = out.coverage[pixel_index(x0 - out.left + column, y0 - out.top + row, out.width)];
      to = std::max(to, glyph_pixels[pixel_index(column, row, width)]);
    });
  });
  return out;
}

}  // namespace hallway::render
