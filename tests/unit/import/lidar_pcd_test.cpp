// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "base/text.hpp"
#include "import/lidar_cloud.hpp"
#include "import/point_collector.hpp"
#include "unit/import/cloud_bytes.hpp"
#include "unit/import/rig_scene.hpp"

namespace hallway::import {
namespace {

using test::RigScene;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A PCD file in text with these fields, all of type F 8 but those whose name ends in an asterisk: U 4.
std::string text_pcd(const std::vector<std::string>& fields, const std::string& rows, std::size_t count) {
  std::string names, sizes, types;
  for (const std::string& field : fields) {
    const bool whole = field.ends_with('*');
    names += ' ' + field.substr(0, field.size() - (whole ? 1 : 0));
    sizes += whole ? " 4" : " 8";
    types += whole ? " U" : " F";
  }
  return fmt::format("FIELDS{}\nSIZE{}\nTYPE{}\nWIDTH {}\nHEIGHT 1\nDATA ascii\n{}", names, sizes, types,
                     count, rows);
}

TEST(LidarPcd, WhatIsWrittenReadsBackTheSame) {
  const LidarCloud cloud = RigScene::cloud(3);
  LidarCloud expected = cloud;
  expected.points = test::as_float32(cloud.points);
  const std::string bytes = print_lidar_pcd(cloud, "a.pcd");
  test::expect_same_cloud(parse_lidar_pcd(bytes, "a.pcd"), expected);
  EXPECT_EQ(print_lidar_pcd(parse_lidar_pcd(bytes, "a.pcd"), "a.pcd"), bytes);
  EXPECT_NE(bytes.find("FIELDS x y z intensity ring t\nSIZE 4 4 4 4 2 4\nTYPE F F F F U U\n"),
            std::string::npos);
}

TEST(LidarPcd, ListsThatAreEmptyHaveNoField) {
  LidarCloud cloud = RigScene::cloud(0, 7);
  cloud.ring.clear();
  cloud.t_offset_ns.clear();
  const std::string bytes = print_lidar_pcd(cloud, "a.pcd");
  EXPECT_NE(bytes.find("FIELDS x y z intensity\n"), std::string::npos);
  EXPECT_TRUE(parse_lidar_pcd(bytes, "a.pcd").ring.empty());
  EXPECT_TRUE(parse_lidar_pcd(bytes, "a.pcd").t_offset_ns.empty());
  EXPECT_TRUE(parse_lidar_pcd(print_lidar_pcd({}, "a.pcd"), "a.pcd").points.empty());
}

TEST(LidarPcd, WideRingsAndTimesBelowZeroFit) {
  LidarCloud cloud{.points = {{1, 2, 3}, {4, 5, 6}},
                   .ring = {70'000, 4'294'967'295},
                   .t_offset_ns = {-50'000'000, 4'294'967'296}};
  test::expect_same_cloud(parse_lidar_pcd(print_lidar_pcd(cloud, "a.pcd"), "a.pcd"), cloud);
}

TEST(LidarPcd, FieldsOfOtherProgramsAreRead) {
  const LidarCloud seconds =
      parse_lidar_pcd(text_pcd({"intensity", "x", "time", "y", "z", "ring*"},
                               "7 1 0.05 2 3 15\nnan 4 -0.01 5 6 0\n1 nan 0 0 0 1\n", 3),
                      "a");
  EXPECT_EQ(seconds.points, (PointList{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(seconds.not_finite, 1u);
  EXPECT_EQ(seconds.intensity.at(0), 7.0f);
  EXPECT_TRUE(std::isnan(seconds.intensity.at(1)));
  EXPECT_EQ(seconds.ring, (std::vector<std::uint32_t>{15, 0}));
  EXPECT_EQ(seconds.t_offset_ns, (std::vector<std::int64_t>{50'000'000, -10'000'000}));
  const LidarCloud both = parse_lidar_pcd(text_pcd({"x", "y", "z", "time", "t*"}, "1 2 3 9 250\n", 1), "a");
  EXPECT_EQ(both.t_offset_ns, std::vector<std::int64_t>{250}) << "t goes before time";
}

TEST(LidarPcd, AllFormsOfDataGiveTheirCoordinates) {
  const test::Points points = test::exact_points(50);
  for (const std::string& content : {test::ascii_pcd(points), test::binary_pcd<float>(points),
                                     test::binary_pcd<double>(points), test::compressed_pcd<float>(points)}) {
    EXPECT_EQ(parse_lidar_pcd(content, "a").points, points);
  }
}

TEST(LidarPcd, ErrorsNameFileAndPlace) {
  const auto refused = [](const std::string& content, const std::string& words) {
    test::expect_error([&] { parse_lidar_pcd(content, "a.pcd"); }, ErrorCode::kBadInput, words);
  };
  refused("", "a.pcd: the header has no line DATA");
  refused(text_pcd({"x", "y", "z", "ring"}, "1 2 3 1\n1 2 3 0.5\n", 2),
          "a.pcd:8: a ring is a whole number from 0 to 2^32 - 1, not 0.5");
  refused(text_pcd({"x", "y", "z", "ring"}, "1 2 3 -1\n", 1), "a.pcd:7: a ring");
  refused(text_pcd({"x", "y", "z", "t"}, "1 2 3 1e9\n", 1),
          "a.pcd:7: a point's time is at most an hour from its cloud's");
  refused(text_pcd({"x", "y", "z", "time*"}, "1 2 3 1\n", 1),
          "field time has whole numbers, whose unit is not known");
  refused(text_pcd({"x", "y", "z", "ring", "ring"}, "1 2 3 1 1\n", 1), "field ring is no one number");
  refused(text_pcd({"x", "y", "z"}, "1 2 1e30\n", 1), "a.pcd:7: a coordinate lies beyond 1e+09 m");
  refused(text_pcd({"x", "y", "z", "intensity"}, "1 2 3 much\n", 1),
          "a.pcd:7: a number is needed, \"much\" found");
  std::string binary = print_lidar_pcd(RigScene::cloud(0, 3), "a.pcd");
  refused(binary.substr(0, binary.size() - 1),
          "3 points of 22 bytes follow, and 65 bytes are there: the file is cut off");
  for (std::size_t size = 0; size < binary.size(); ++size) refused(binary.substr(0, size), "a.pcd");
  const float huge = 1e30f;
  binary.replace(binary.size() - 22, sizeof huge, test::bytes_of(huge));
  refused(binary, "a.pcd: point 2: a coordinate lies beyond 1e+09 m");
}

TEST(LidarPcd, ACloudThatCannotBeWrittenIsRefused) {
  const auto refused = [](const LidarCloud& cloud, const std::string& words) {
    test::expect_error([&] { print_lidar_pcd(cloud, "a.pcd"); }, ErrorCode::kBadInput, words);
  };
  refused({.points = {{1, 2, 3}, {1, kNan, 3}}}, "a.pcd: point 1 is not finite, or lies beyond 1e+09 m");
  refused({.points = {{1, 2, 1e10}}}, "a.pcd: point 0 is not finite");
  refused({.points = PointList(kMaxFramePoints + 1)}, "a.pcd: 5592235 points, and a frame holds 5592234");
  refused({.points = {{1, 2, 3}}, .ring = {1, 2}}, "a.pcd: 2 rings for 1 points");
}

}  // namespace
}  // namespace hallway::import
