// SPDX-License-Identifier: MIT
#include "image/png.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>

#include "base/error.hpp"
#include "base/text.hpp"

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

/// A PNG file that is being read.
struct Reading {
  explicit Reading(std::string_view bytes)
      : rest(bytes),
        png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &message, keep_message, ignore_warning)) {
    if (png != nullptr) info = png_create_info_struct(png);
  }
  ~Reading() { png_destroy_read_struct(&png, &info, nullptr); }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

  std::string_view rest;
  std::string message = "no memory";
  png_structp png = nullptr;
  png_infop info = nullptr;
};

void take(png_structp png, png_bytep bytes, std::size_t count) {
  auto& reading = *static_cast<Reading*>(png_get_io_ptr(png));
  if (count > reading.rest.size()) png_error(png, "the file is cut off");
  std::memcpy(bytes, reading.rest.data(), count);
  reading.rest.remove_prefix(count);
}

/// Like write_all(), these two are left by longjmp on an error.
bool read_header(Reading& reading) {
  if (setjmp(png_jmpbuf(reading.png)) != 0) return false;
  png_set_read_fn(reading.png, &reading, take);
  png_read_info(reading.png, reading.info);
  return true;
}

bool read_rows(Reading& reading, png_bytepp rows) {
  if (setjmp(png_jmpbuf(reading.png)) != 0) return false;
  png_set_swap(reading.png);  // values stand there with their high byte first
  png_read_image(reading.png, rows);
  png_read_end(reading.png, nullptr);
  return true;
}

[[noreturn]] void refuse_png(const std::string& cause) {
  throw Error(ErrorCode::kBadInput, "cannot be read as PNG: " + cause);
}

/// libpng takes memory for as many bytes as a chunk says that it has, before it looks whether they are there.
void check_chunk_lengths(std::string_view bytes) {
  constexpr std::size_t kSignature = 8, kAround = 12;  // length, kind and check sum of a chunk
  bytes.remove_prefix(std::min(bytes.size(), kSignature));
  while (bytes.size() >= kAround) {
    const std::size_t length = png_get_uint_32(reinterpret_cast<png_const_bytep>(bytes.data()));
    if (length > bytes.size() - kAround) refuse_png("the file is cut off");
    bytes.remove_prefix(kAround + length);
  }
}

}  // namespace

Gray16 decode_gray16(std::string_view png, std::uint64_t max_pixels) {
  check_chunk_lengths(png);
  Reading reading(png);
  if (reading.info == nullptr) throw Error(ErrorCode::kInternal, "libpng: " + reading.message);
  if (!read_header(reading)) refuse_png(printable(reading.message));
  Gray16 image{png_get_image_width(reading.png, reading.info),
               png_get_image_height(reading.png, reading.info)};
  const int bits = png_get_bit_depth(reading.png, reading.info);
  if (png_get_color_type(reading.png, reading.info) != PNG_COLOR_TYPE_GRAY || bits != 16) {
    throw Error(ErrorCode::kBadInput,
                fmt::format("is no grey PNG picture of 16 bits ({} bits a channel)", bits));
  }
  const std::uint64_t pixels = std::uint64_t{image.width_px} * image.height_px;
  if (pixels > max_pixels) {
    throw Error(ErrorCode::kBadInput, fmt::format("has {} x {} pixels; at most {} are read", image.width_px,
                                                  image.height_px, max_pixels));
  }
  image.values.resize(static_cast<std::size_t>(pixels));
  std::vector<png_bytep> rows;
  for (std::size_t y = 0; y < image.height_px; ++y) {
    rows.push_back(reinterpret_cast<png_bytep>(image.values.data() + y * image.width_px));
  }
  if (!read_rows(reading, rows.data())) refuse_png(printable(reading.message));
  return image;
}

std::string encode_png(const Pixels& pixels, PngEffort effort) {
  check(pixels);
  if (effort == PngEffort::kQuick) return encode_with(pixels, {PNG_ALL_FILTERS, 6});
  // Lines and flat colours compress best without a filter, shaded faces with one; which it is shows only afterwards.
  std::string plain = encode_with(pixels, {PNG_FILTER_NONE, 9});
  std::string filtered = encode_with(pixels, {PNG_ALL_FILTERS, 9});
  return plain.size() <= filtered.size() ? plain : filtered;
}

}  // namespace hallway
