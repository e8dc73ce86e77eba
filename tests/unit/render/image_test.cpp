// SPDX-License-Identifier: MIT
#include "render/image.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <cstring>
#include <set>
#include <string>
#include <tuple>

#include "base/error.hpp"
#include "base/random.hpp"
#include "render/png.hpp"

namespace hallway::render {
namespace {

Image noise(int width, int height) {
  const Random random(1, stream_id("test.image"));
  Image image{width, height, {}};
  const auto count = static_cast<std::uint64_t>(3 * width * height);
  for (std::uint64_t i = 0; i < count; ++i) {
    image.bytes.push_back(static_cast<std::uint8_t>(random.bits(0, i)[0] & 0xFFu));
  }
  return image;
}

Image decode(const std::string& bytes) {
  png_image header;
  std::memset(&header, 0, sizeof header);
  header.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()), 0) << header.message;
  header.format = PNG_FORMAT_RGB;
  Image image{static_cast<int>(header.width), static_cast<int>(header.height), {}};
  image.bytes.resize(PNG_IMAGE_SIZE(header));
  EXPECT_NE(png_image_finish_read(&header, nullptr, image.bytes.data(), 0, nullptr), 0) << header.message;
  return image;
}

TEST(Png, DecodesToTheSamePixels) {
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {64, 50}}) {
    const Image image = noise(width, height);
    const Image back = decode(encode_png(image));
    EXPECT_EQ(back.width_px, width);
    EXPECT_EQ(back.height_px, height);
    EXPECT_EQ(back.bytes, image.bytes);
  }
}

TEST(Png, SameImageGivesSameBytes) {
  EXPECT_EQ(encode_png(noise(40, 30)), encode_png(noise(40, 30)));
}

TEST(Png, HasNoTimeAndNoText) {
  const std::string bytes = encode_png(noise(8, 8));
  for (const char* chunk : {"tIME", "tEXt", "iTXt", "zTXt"})
    EXPECT_EQ(bytes.find(chunk), std::string::npos) << chunk;
}

TEST(Png, RefusesAnImageWhoseBytesDoNotFitItsSize) {
  Image image = noise(4, 4);
  image.bytes.pop_back();
  EXPECT_THROW(encode_png(image), Error);
  EXPECT_THROW(encode_png(Image{}), Error);
}

TEST(ImageSize, RefusesWhatCannotBeDrawn) {
  for (const auto& [width, height] : {std::pair<std::int64_t, std::int64_t>{0, 0},
                                      {0, 10},
                                      {10, 0},
                                      {-1, 10},
                                      {100000, 100000},
                                      {kMaxImageSide_px + 1, 1},
                                      {16384, 16384},
                                      {std::int64_t{1} << 62, std::int64_t{1} << 62}}) {
    try {
      check_image_size(width, height);
      ADD_FAILURE() << width << "x" << height << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kBadInput);
      EXPECT_NE(error.message().find(std::to_string(width)), std::string::npos) << error.message();
    }
  }
}

TEST(ImageSize, AcceptsOnePixelAndALongStrip) {
  EXPECT_NO_THROW(check_image_size(1, 1));
  EXPECT_NO_THROW(check_image_size(kMaxImageSide_px, 2048));
}

TEST(Colours, MaterialDependsOnTheNameAlone) {
  EXPECT_EQ(material_colour("office/WALL_2"), material_colour("wall"));
  EXPECT_EQ(material_colour("xyzzy"), material_colour("xyzzy"));
  EXPECT_NE(material_colour("wall"), material_colour("floor"));
}

TEST(Colours, NeighbouringSubmapsDiffer) {
  std::set<std::tuple<int, int, int>> seen;
  for (std::size_t i = 0; i < 32; ++i) {
    const Rgb a = submap_colour(i);
    const Rgb b = submap_colour(i + 1);
    EXPECT_GT(std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b), 90) << i;
    seen.insert({a.r, a.g, a.b});
  }
  EXPECT_EQ(seen.size(), 32u);
}

}  // namespace
}  // namespace hallway::render
