// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "base/random.hpp"
#include "import/lzf.hpp"
#include "import/pcd.hpp"
#include "import/ply.hpp"
#include "support/errors.hpp"
#include "unit/import/cloud_bytes.hpp"

namespace hallway::import {
namespace {

using test::exact_points;
using test::Points;

Frame read(const std::string& content, std::uint32_t stride = 1) {
  Frame frame;
  PointCollector points(frame, stride);
  content.starts_with("ply") ? read_ply(content, "cloud", points) : read_pcd(content, "cloud", points);
  return frame;
}

/// The same points in every form that is read.
std::vector<std::string> all_forms(const Points& points) {
  return {test::ascii_ply(points),
          test::binary_ply<float>(points),
          test::binary_ply<double>(points),
          test::binary_ply<float>(points, true),
          test::binary_ply<double>(points, true),
          test::ascii_pcd(points),
          test::binary_pcd<float>(points),
          test::binary_pcd<double>(points),
          test::compressed_pcd<float>(points),
          test::compressed_pcd<double>(points)};
}

std::string error_text(const std::string& content) {
  const auto error = test::error_of([&] { read(content); });
  if (!error) return "none";
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  return error->what();
}

TEST(Clouds, EveryFormGivesTheSameBits) {
  for (const std::size_t count : {0u, 1u, 2u, 500u}) {
    const Points points = exact_points(count);
    for (const std::string& content : all_forms(points)) {
      EXPECT_EQ(read(content).points, points) << content.substr(0, 60);
    }
  }
}

TEST(Clouds, PointsOfAnOrganisedPcdArePixels) {
  Points points = exact_points(12);
  points[4][1] = std::numeric_limits<double>::quiet_NaN();
  for (std::string content :
       {test::ascii_pcd(points), test::binary_pcd<float>(points), test::compressed_pcd<double>(points)}) {
    EXPECT_EQ(read(content).image.width, 0u);
    EXPECT_TRUE(read(content).image.pixels.empty());
    content.replace(content.find("WIDTH 12\nHEIGHT 1"), 17, "WIDTH 4\nHEIGHT 3");
    const Frame all = read(content);
    EXPECT_EQ(all.image.width, 4u);
    EXPECT_EQ(all.image.height, 3u);
    EXPECT_EQ(all.image.pixels, (std::vector<std::uint32_t>{0, 1, 2, 3, 5, 6, 7, 8, 9, 10, 11}));
    const Frame thinned = read(content, 3);
    EXPECT_EQ(thinned.image.width, 4u);
    EXPECT_EQ(thinned.image.pixels, (std::vector<std::uint32_t>{0, 3, 6, 9}));
  }
}

TEST(Clouds, AnImageTooLargeToTellIsNone) {
  Frame frame;
  PointCollector points(frame, 1);
  points.begin_image(1u << 15, (1u << 13) + 1);
  points.add(1, 2, 3);
  EXPECT_EQ(frame.image.width, 0u);
  EXPECT_TRUE(frame.image.pixels.empty());
  EXPECT_EQ(frame.points.size(), 1u);
}

TEST(Clouds, DoublesAndDecimalsKeepTheirValue) {
  const Points points{{0.1, -1e-300, 1.0 / 3.0}, {123456789.123456789, 5e-324, -0.0}};
  EXPECT_EQ(read(test::ascii_ply(points)).points, points);
  EXPECT_EQ(read(test::binary_ply<double>(points)).points, points);
  EXPECT_EQ(read(test::ascii_pcd(points)).points, points);
  EXPECT_EQ(read(test::compressed_pcd<double>(points)).points, points);
  EXPECT_EQ(read(test::binary_ply<float>(points)).points[0][0], static_cast<double>(0.1f));
}

TEST(Clouds, PointsThatAreNotFiniteAreLeftOutAndCounted) {
  Points points = exact_points(10);
  points[2][1] = std::numeric_limits<double>::quiet_NaN();
  points[5][0] = -std::numeric_limits<double>::infinity();
  Points left = points;
  left.erase(left.begin() + 5);
  left.erase(left.begin() + 2);
  for (const std::string& content : all_forms(points)) {
    const Frame frame = read(content);
    EXPECT_EQ(frame.points, left) << content.substr(0, 60);
    EXPECT_EQ(frame.not_finite, 2u);
  }
}

TEST(Clouds, StrideTakesEachNthPoint) {
  const Points points = exact_points(10);
  for (const std::string& content : all_forms(points)) {
    EXPECT_EQ(read(content, 4).points, (Points{points[0], points[4], points[8]}));
    EXPECT_EQ(read(content, 100).points, Points{points[0]});
  }
}

TEST(Clouds, AFileThatIsCutAnywhereIsAnError) {
  for (const std::string& content : all_forms(exact_points(5))) {
    for (std::size_t size = 0; size < content.size(); ++size) {
      EXPECT_NE(error_text(content.substr(0, size)), "none") << size << " of " << content.substr(0, 60);
    }
  }
}

TEST(Clouds, FlippedBytesAreAnErrorOrOtherPoints) {
  const Random random(3, stream_id("test.clouds"));
  std::uint64_t draw = 0;
  for (const std::string& content : all_forms(exact_points(20))) {
    for (int i = 0; i < 300; ++i) {
      std::string damaged = content;
      const auto bits = random.bits(0, draw++);
      damaged[bits[0] % damaged.size()] = static_cast<char>(bits[1] & 0xFFu);
      const auto error = test::error_of([&] { EXPECT_LE(read(damaged).points.size(), 20'000u); });
      EXPECT_TRUE(!error || error->code() == ErrorCode::kBadInput);
    }
  }
}

TEST(Clouds, HugeCountsAreRefusedBeforeMemoryIsTaken) {
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const Points points = exact_points(3);
  EXPECT_NE(
      error_text(with(test::binary_ply<float>(points), "vertex 3", "vertex 1073741824")).find("cut off"),
      std::string::npos);
  EXPECT_NE(error_text(with(test::binary_ply<float>(points), "vertex 3", "vertex 99999999999999999999"))
                .find("cloud:4: a whole number up to 1073741824 is needed"),
            std::string::npos);
  const std::string pcd = with(test::compressed_pcd<float>(points), "POINTS 3", "POINTS 1073741824");
  EXPECT_NE(error_text(pcd).find("WIDTH and HEIGHT give 3"), std::string::npos);
  EXPECT_NE(error_text(with(pcd, "WIDTH 3", "WIDTH 1073741824")).find("are compressed"), std::string::npos);
  EXPECT_NE(error_text(with(with(pcd, "WIDTH 3", "WIDTH 1073741824"), "HEIGHT 1", "HEIGHT 1073741824"))
                .find("1152921504606846976"),
            std::string::npos);
  EXPECT_NE(error_text(with(test::binary_pcd<float>(points), "COUNT 1 1 1 1 3", "COUNT 1 1 1 1 99999999"))
                .find(":6:"),
            std::string::npos);
}

TEST(Clouds, ErrorsNameTheLine) {
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 2\n";
  const std::string xyz = "property float x\nproperty float y\nproperty float z\nend_header\n";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"plx\n", "\"plx\" is no word of a PCD header"},
      {"ply\nformat ascii 1.0\nelement face 2\n", "cloud:3: the first element is \"face\""},
      {"ply\nformat ebcdic 1.0\n", "cloud:2: unknown format \"ebcdic\""},
      {head + "property list uchar float x\n", "cloud:4: vertices with lists are not read"},
      {head + "property float x\nproperty float x\n", "cloud:5: a vertex has x twice"},
      {head + "property float x\nend_header\n", "no properties x, y and z"},
      {head + xyz + "1 2 3\n1 2\n", "cloud:9: 2 numbers where a point has 3"},
      {head + xyz + "1 2 3\n1 2 0x3\n", "cloud:9: a number is needed, \"0x3\" found"},
      {head + xyz + "1 2 3\n", "ends after 1 of 2 points"},
      {head + xyz + "1 2 3\n1 2 3", "cut off here"},
      {"VERSION 0.7\nSIZE 4\n", "cloud:2: FIELDS must stand before it"},
      {"FIELDS x y z\nSIZE 4 4\n", "cloud:2: 2 values for 3 fields"},
      {"FIELDS x y z\nSIZE 4 4 4\nTYPE F F Q\n", "cloud:3: I, U or F is needed, \"Q\" found"},
      {"FIELDS x y z\nSIZE 4 4 3\nTYPE F F F\nWIDTH 0\nDATA ascii\n", "field z is no one number"},
      {"FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 0\nDATA zip\n", "unknown form of data \"zip\""},
      {"FIELDS x y w\nSIZE 4 4 4\nTYPE F F F\nWIDTH 0\nDATA ascii\n", "no fields x, y and z"},
  };
  for (const auto& [content, words] : cases) {
    EXPECT_NE(error_text(content).find(words), std::string::npos) << error_text(content);
  }
}

TEST(Clouds, ALineAsLongAsAFileIsRefused) {
  EXPECT_NE(error_text("FIELDS " + std::string(2 << 20, 'x') + "\n").find("a line of"), std::string::npos);
}

TEST(Lzf, UndoesWhatWasCompressed) {
  const Random random(5, stream_id("test.lzf"));
  for (std::uint32_t round = 0; round < 20; ++round) {
    std::string bytes;
    for (std::uint64_t i = 0; i < 200 * round; ++i) {
      // Few values make many repetitions, some of them longer than a control byte can say.
      bytes += static_cast<char>(random.bits(round, i)[0] % (1 + round % 5));
    }
    const std::string packed = test::compress_lzf(bytes);
    EXPECT_EQ(decompress_lzf(packed, bytes.size()), bytes);
    EXPECT_TRUE(test::error_of([&] { decompress_lzf(packed, bytes.size() + 1); }));
    if (!bytes.empty()) {
      EXPECT_TRUE(test::error_of([&] { decompress_lzf(packed, bytes.size() - 1); }));
    }
  }
}

TEST(Lzf, RefusesWhatItCannotGive) {
  EXPECT_TRUE(test::error_of([] { decompress_lzf(std::string("\x20\x05", 2), 3); }))
      << "before the beginning";
  EXPECT_TRUE(test::error_of([] { decompress_lzf(std::string("\0a\xe0\xff", 4), 265); })) << "half a step";
  EXPECT_TRUE(test::error_of([] { decompress_lzf("", std::uint64_t{1} << 60); })) << "before memory is taken";
  EXPECT_EQ(decompress_lzf(std::string("\0a\xe0\xff\0", 5), 265), std::string(265, 'a'))
      << "the longest repetition";
}

}  // namespace
}  // namespace hallway::import
