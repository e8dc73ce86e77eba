// SPDX-License-Identifier: MIT
#include "loaders/image_decoder.hpp"

#include <climits>
#include <cstdlib>
#include <memory>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "loaders/refuse.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace hallway::loaders {
namespace {

constexpr std::uint64_t kMaxEdge_px = 16'384;

/// The size that a PNG's header states, where it is one. stb's own reading of the header refuses huge images without saying
/// that this is the reason.
std::optional<std::pair<std::uint64_t, std::uint64_t>> png_size(std::string_view bytes) {
  constexpr std::size_t kWidth = 16;
  constexpr std::size_t kHeight = 20;
  if (bytes.size() < kHeight + 4 || !bytes.starts_with("\x89PNG\r\n\x1a\n")) return std::nullopt;
  const auto number = [&](std::size_t at) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
  };
  return std::pair{number(kWidth), number(kHeight)};
}

/// Whether each Huffman table of a JPEG picture has at most the 256 symbols that there are. stb of Debian 12 writes behind its array
/// for one that has more. Segments are found as stb finds them: what is no marker is passed over.
bool huffman_tables_fit(std::string_view bytes) {
  // Behind its end stb reads zeros.
  const auto at = [&](std::size_t i) { return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u; };
  constexpr unsigned kTables = 0xC4;
  constexpr std::size_t kCounts = 16;
  for (std::size_t i = 0; i < bytes.size();) {
    const unsigned marker = at(i) == 0xFF ? at(i + 1) : 0;
    const bool alone = marker == 0 || marker == 1 || marker == 0xFF || (marker >= 0xD0 && marker <= 0xD9);
    if (alone) {
      ++i;
      continue;
    }
    const std::size_t length = static_cast<std::size_t>(at(i + 2)) << 8 | at(i + 3);
    const std::size_t end = i + 2 + length;
    for (std::size_t table = i + 4; marker == kTables && table < end && table < bytes.size();) {
      std::size_t symbols = 0;
      for (std::size_t k = 1; k <= kCounts; ++k) symbols += at(table + k);
      if (symbols > 256) return false;
      table += 1 + kCounts + symbols;
    }
    i = end;
  }
  return true;
}

struct Free {
  void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

}  // namespace

void ImageDecoder::check_room(std::uint64_t width, std::uint64_t height, const std::string& name) const {
  if (width <= kMaxEdge_px && height <= kMaxEdge_px && 4 * width * height <= bytes_left_) return;
  refuse("the image " + printable(name) + " has " + std::to_string(width) + " x " + std::to_string(height) +
         " pixels, which is over the limit");
}

void ImageDecoder::reserve(std::uint64_t width, std::uint64_t height, const std::string& name) {
  check_room(width, height, name);
  bytes_left_ -= 4 * width * height;
}

std::variant<mesh::Image, std::string> ImageDecoder::decode(std::string_view bytes, const std::string& name) {
  if (bytes.size() > INT_MAX) return std::string("is too large");
  if (const auto stated = png_size(bytes)) check_room(stated->first, stated->second, name);
  // A JPEG picture may have any number of such bytes before its first marker.
  if (bytes.starts_with('\xFF') && !huffman_tables_fit(bytes))
    return std::string("has a damaged Huffman table");
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0;
  int height = 0;
  int channels = 0;
  if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0 || width <= 0 || height <= 0)
    return std::string("is no PNG, JPEG, BMP or TGA image");
  reserve(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height), name);
  const std::unique_ptr<stbi_uc, Free> pixels(
      stbi_load_from_memory(data, size, &width, &height, &channels, 4));
  if (!pixels) return "cannot be decoded: " + std::string(stbi_failure_reason());
  mesh::Image image;
  image.name = name;
  image.width = static_cast<std::uint32_t>(width);
  image.height = static_cast<std::uint32_t>(height);
  image.rgba.assign(pixels.get(), pixels.get() + std::size_t{4} * image.width * image.height);
  return image;
}

}  // namespace hallway::loaders
