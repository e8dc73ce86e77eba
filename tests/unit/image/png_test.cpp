// SPDX-License-Identifier: MIT
#include "image/png.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <cstring>
#include <vector>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/random.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/gray_png.hpp"

namespace hallway {
namespace {

std::vector<std::uint8_t> noise(std::size_t count) {
  const Random random(1, stream_id("test.png"));
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < count; ++i)
    bytes.push_back(static_cast<std::uint8_t>(random.bits(0, i)[0] & 0xFFu));
  return bytes;
}

/// Bytes of a PNG file in so many channels; empty for another size.
std::vector<std::uint8_t> decode(const std::string& bytes, const Pixels& like) {
  png_image header;
  std::memset(&header, 0, sizeof header);
  header.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()), 0) << header.message;
  const bool alpha = (header.format & PNG_FORMAT_FLAG_ALPHA) != 0;
  EXPECT_EQ(alpha, like.channels == 4);
  if (header.width != like.width_px || header.height != like.height_px) return {};
  header.format = alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  std::vector<std::uint8_t> out(PNG_IMAGE_SIZE(header));
  EXPECT_NE(png_image_finish_read(&header, nullptr, out.data(), 0, nullptr), 0) << header.message;
  return out;
}

TEST(Png, DecodesToTheSamePixels) {
  for (const std::uint32_t channels : {3u, 4u}) {
    for (const auto& [width, height] : {std::pair{1u, 1u}, {7u, 3u}, {64u, 50u}}) {
      const auto bytes = noise(std::size_t{channels} * width * height);
      const Pixels pixels{width, height, channels, bytes};
      EXPECT_EQ(decode(encode_png(pixels, PngEffort::kQuick), pixels), bytes);
      EXPECT_EQ(decode(encode_png(pixels, PngEffort::kShortest), pixels), bytes);
    }
  }
}

TEST(Png, ALongStripIsFine) {
  const auto bytes = noise(3 * 1'500'000);
  const Pixels pixels{1'500'000, 1, 3, bytes};
  // The reader has limits of its own, so only the header is looked at.
  const std::string png = encode_png(pixels, PngEffort::kQuick);
  EXPECT_EQ(png.substr(16, 8), std::string("\x00\x16\xe3\x60\0\0\0\1", 8));
}

TEST(Png, RefusesBytesThatDoNotFitTheSize) {
  const auto bytes = noise(48);
  for (const Pixels& bad : {Pixels{4, 4, 4, bytes}, Pixels{4, 3, 3, bytes}, Pixels{0, 0, 3, {}},
                            Pixels{0, 4, 3, bytes}, Pixels{4, 0, 3, {}}, Pixels{4, 6, 2, bytes}}) {
    EXPECT_THROW(encode_png(bad, PngEffort::kQuick), Error);
  }
  EXPECT_NO_THROW(encode_png({4, 4, 3, bytes}, PngEffort::kQuick));
}

std::vector<std::uint16_t> gray_noise(std::size_t count) {
  const Random random(2, stream_id("test.gray"));
  std::vector<std::uint16_t> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(static_cast<std::uint16_t>(random.bits(0, i)[0] & 0xFFFFu));
  }
  return values;
}

TEST(GrayPng, DecodesToTheValuesThatWereWritten) {
  for (const auto& [width, height] : {std::pair{1u, 1u}, {7u, 3u}, {640u, 48u}}) {
    const auto values = gray_noise(std::size_t{width} * height);
    const Gray16 image = decode_gray16(test::gray_png(width, height, values), std::uint64_t{width} * height);
    EXPECT_EQ(image.width_px, width);
    EXPECT_EQ(image.height_px, height);
    EXPECT_EQ(image.values, values);
  }
}

TEST(GrayPng, RefusesOtherKindsAndTooManyPixels) {
  const auto bytes = noise(48);
  const auto colour = test::error_of([&] {
    decode_gray16(encode_png(Pixels{4, 4, 3, bytes}, PngEffort::kQuick), 100);
  });
  ASSERT_TRUE(colour);
  EXPECT_NE(colour->message().find("16 bits"), std::string::npos);
  const auto large = test::error_of([&] { decode_gray16(test::gray_png(5, 4, gray_noise(20)), 19); });
  ASSERT_TRUE(large);
  EXPECT_EQ(large->message(), "has 5 x 4 pixels; at most 19 are read");
}

TEST(GrayPng, CutOrDamagedFilesAreErrors) {
  const std::string whole = test::gray_png(20, 10, gray_noise(200));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto error = test::error_of([&] { decode_gray16(whole.substr(0, size), 1000); });
    ASSERT_TRUE(error) << size;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  }
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    // A chunk that need not be understood may be damaged unnoticed; the values may not.
    const auto error =
        test::error_of([&] { EXPECT_EQ(decode_gray16(damaged, 1000).values, gray_noise(200)) << at; });
    EXPECT_TRUE(!error || error->code() == ErrorCode::kBadInput);
  }
}

TEST(GrayPng, FilesThatCrashedDecodersAreErrorsOrPictures) {
  HALLWAY_DATA_OR_SKIP(folder, "models/bad_png");
  std::size_t seen = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".png") continue;
    ++seen;
    const auto error = test::error_of([&] { decode_gray16(read_file(entry.path()), 1 << 24); });
    EXPECT_TRUE(!error || error->code() == ErrorCode::kBadInput) << entry.path();
  }
  EXPECT_GT(seen, 0u);
}

}  // namespace
}  // namespace hallway
