// SPDX-License-Identifier: MIT
#include "image/grey_picture.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"

namespace hallway {
namespace {

constexpr std::uint32_t kMaxSide = 4096;

/// A reader of libpng's that is freed whatever happens.
struct Reader {
  png_image image{};
  Reader() { image.version = PNG_IMAGE_VERSION; }
  ~Reader() { png_image_free(&image); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
};

/// A PNG file without what it says about colours: a height is the number in the file, whatever light it would be on a screen.
std::string bare(const std::string& bytes) {
  constexpr std::size_t kSignature = 8, kFrame = 12;  // a chunk's length, type and checksum
  std::string result = bytes.substr(0, kSignature);
  for (std::size_t at = kSignature; at + kFrame <= bytes.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(bytes[at + i]);
    if (length > bytes.size() - at - kFrame) return bytes;  // libpng says what is wrong with it
    const char first = bytes[at + 4];
    if (first >= 'A' && first <= 'Z')
      result.append(bytes, at, length + kFrame);  // chunks without which there is no picture
    at += length + kFrame;
  }
  return result;
}

template <typename Number>
std::vector<double> pixels(png_image& image, double white) {
  std::vector<Number> raw(std::size_t{image.width} * image.height);
  const png_color black{0, 0, 0};
  if (png_image_finish_read(&image, &black, raw.data(), 0, nullptr) == 0) return {};
  std::vector<double> values;
  values.reserve(raw.size());
  for (const Number number : raw) values.push_back(static_cast<double>(number) / white);
  return values;
}

}  // namespace

double GreyPicture::at(double u, double v) const {
  const double x = std::clamp(u, 0.0, 1.0) * (width - 1), y = std::clamp(v, 0.0, 1.0) * (height - 1);
  const auto left = static_cast<std::uint32_t>(x), top = static_cast<std::uint32_t>(y);
  const std::uint32_t right = std::min(left + 1, width - 1), bottom = std::min(top + 1, height - 1);
  const auto pixel = [&](std::uint32_t column, std::uint32_t row) {
    return values[std::size_t{row} * width + column];
  };
  const double over = std::lerp(pixel(left, top), pixel(right, top), x - left);
  const double under = std::lerp(pixel(left, bottom), pixel(right, bottom), x - left);
  return std::lerp(over, under, y - top);
}

GreyPicture read_grey_png(const std::filesystem::path& file) {
  const std::string bytes = bare(read_file(file));
  Reader reader;
  png_image& image = reader.image;
  const auto refuse = [&](const char* why) {
    throw Error(ErrorCode::kBadInput, fmt::format("{}: {}", printable(file.string()), why));
  };
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) refuse("is no PNG picture");
  if (image.width > kMaxSide || image.height > kMaxSide) refuse("is larger than 4096 pixels a side");
  const bool deep = (image.format & PNG_FORMAT_FLAG_LINEAR) != 0;  // 16 bits a channel, taken as they are
  image.format = deep ? PNG_FORMAT_LINEAR_Y : PNG_FORMAT_GRAY;
  GreyPicture picture{image.width, image.height, {}};
  picture.values = deep ? pixels<png_uint_16>(image, 65535.0) : pixels<png_byte>(image, 255.0);
  if (picture.values.empty()) refuse("is a PNG picture that is damaged");
  return picture;
}

}  // namespace hallway
