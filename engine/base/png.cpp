// SPDX-License-Identifier: MIT
#include "base/png.hpp"

#include <fmt/format.h>
#include <png.h>

#include <csetjmp>

#include "base/error.hpp"

namespace hallway {
namespace {

void append(png_structp png, png_bytep bytes, std::size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), count);
}

void keep_message(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

struct Settings {
  int filters;
  int level;
};

/// The part between the making and the freeing of libpng's data. libpng leaves it by longjmp on an error, so nothing in
/// here may need a destructor.
bool write_all(png_structp png, png_infop info, const Pixels& pixels, const Settings& settings) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_IHDR(png, info, pixels.width_px, pixels.height_px, 8,
               pixels.channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, settings.filters);
  png_set_compression_level(png, settings.level);
  png_write_info(png, info);
  const std::size_t row_bytes = std::size_t{pixels.channels} * pixels.width_px;
  for (std::size_t y = 0; y < pixels.height_px; ++y) {
    png_write_row(png, pixels.bytes.data() + y * row_bytes);
  }
  png_write_end(png, info);
  return true;
}

std::string encode_with(const Pixels& pixels, const Settings& settings) {
  std::string out;
  std::string message = "no memory";
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, keep_message, ignore_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  bool done = false;
  if (info != nullptr) {
    png_set_write_fn(png, &out, append, nullptr);
    done = write_all(png, info, pixels, settings);
  }
  png_destroy_write_struct(&png, &info);
  if (!done) throw Error(ErrorCode::kInternal, "libpng: " + message);
  return out;
}

void check(const Pixels& pixels) {
  if (pixels.channels != 3 && pixels.channels != 4)
    throw Error(ErrorCode::kBadInput, fmt::format("an image of {} channels", pixels.channels));
  const std::uint64_t row = std::uint64_t{pixels.channels} * pixels.width_px;
  const bool fits = row > 0 && pixels.height_px > 0 && pixels.bytes.size() / row == pixels.height_px &&
                    pixels.bytes.size() % row == 0;
  if (fits) return;
  throw Error(ErrorCode::kBadInput, fmt::format("an image of {}x{} pixels has {} bytes", pixels.width_px,
                                                pixels.height_px, pixels.bytes.size()));
}

}  // namespace

std::string encode_png(const Pixels& pixels, PngEffort effort) {
  check(pixels);
  if (effort == PngEffort::kQuick) return encode_with(pixels, {PNG_ALL_FILTERS, 6});
  // Lines and flat colours compress best without a filter, shaded faces with one; which it is shows only afterwards.
  std::string plain = encode_with(pixels, {PNG_FILTER_NONE, 9});
  std::string filtered = encode_with(pixels, {PNG_ALL_FILTERS, 9});
  return plain.size() <= filtered.size() ? plain : filtered;
}

}  // namespace hallway
