// SPDX-License-Identifier: MIT
#include "render/png.hpp"

#include <fmt/format.h>
#include <png.h>

#include <csetjmp>

#include "base/error.hpp"

namespace hallway::render {
namespace {

void append(png_structp png, png_bytep bytes, std::size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), count);
}

void keep_message(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

/// The part between the making and the freeing of libpng's data. libpng leaves it by longjmp on an error, so nothing in
/// here may need a destructor.
bool write_all(png_structp png, png_infop info, const Image& image, int filters) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width_px), static_cast<png_uint_32>(image.height_px),
               8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, filters);
  png_set_compression_level(png, 9);
  png_write_info(png, info);
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(image.width_px);
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.height_px); ++y) {
    png_write_row(png, image.bytes.data() + y * row_bytes);
  }
  png_write_end(png, info);
  return true;
}

std::string encode_with(const Image& image, int filters) {
  std::string out;
  std::string message = "no memory";
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, keep_message, ignore_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  bool done = false;
  if (info != nullptr) {
    png_set_write_fn(png, &out, append, nullptr);
    done = write_all(png, info, image, filters);
  }
  png_destroy_write_struct(&png, &info);
  if (!done) throw Error(ErrorCode::kInternal, "libpng: " + message);
  return out;
}

}  // namespace

std::string encode_png(const Image& image) {
  check_image_size(image.width_px, image.height_px);
  const std::size_t size =
      3 * static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
  if (image.bytes.size() != size) {
    throw Error(ErrorCode::kBadInput, fmt::format("an image of {}x{} pixels has {} bytes instead of {}",
                                                  image.width_px, image.height_px, image.bytes.size(), size));
  }
  // Lines and flat colours compress best without a filter, shaded faces with one; which it is shows only afterwards.
  std::string plain = encode_with(image, PNG_FILTER_NONE);
  std::string filtered = encode_with(image, PNG_ALL_FILTERS);
  return plain.size() <= filtered.size() ? plain : filtered;
}

}  // namespace hallway::render
