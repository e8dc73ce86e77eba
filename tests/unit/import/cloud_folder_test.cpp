// SPDX-License-Identifier: MIT
#include "import/cloud_folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>

#include "import/kind.hpp"
#include "import/point_collector.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/import/cloud_bytes.hpp"

namespace hallway::import {
namespace {

/// A cloud of one point, which says which file it is.
std::string marked(double x) {
  return test::ascii_ply({{x, 0, 0}});
}

std::vector<double> order_of(Recording& recording) {
  std::vector<double> marks;
  Frame frame;
  for (std::uint32_t i = 0; i < recording.frames(); ++i) {
    recording.read(i, frame);
    marks.push_back(frame.points.at(0)[0]);
  }
  return marks;
}

std::string error_text(const std::filesystem::path& path, const CloudOptions& options = {}) {
  const auto error = test::error_of([&] {
    const auto recording = open_clouds(path, options);
    Frame frame;
    for (std::uint32_t i = 0; i < recording->frames(); ++i) recording->read(i, frame);
  });
  return error ? error->what() : "none";
}

TEST(CloudFolder, NumbersInNamesOrderTheFramesAndThePeriodTimesThem) {
  const test::TempFolder folder;
  folder.write("scan_10.ply", marked(10));
  folder.write("scan_9.PLY", marked(9));
  folder.write("scan_0011.ply", marked(11));
  folder.write("scan_2.pcd", test::ascii_pcd({{2, 0, 0}}));
  folder.write("readme_1.txt", "not a cloud");
  const auto recording = open_clouds(folder.path(), {.period_ns = 5});
  EXPECT_EQ(order_of(*recording), (std::vector<double>{2, 9, 10, 11}));
  Frame frame;
  recording->read(3, frame);
  EXPECT_EQ(frame.t_ns, 15);
  recording->read(0, frame);
  EXPECT_EQ(frame.t_ns, 0);
  EXPECT_EQ(frame.points.size(), 1u) << "a frame is a function of its number";
  EXPECT_EQ(recording->period_ns(), 5);
  EXPECT_FALSE(recording->has_truth());
}

TEST(CloudFolder, NumbersMayHaveAPointAndAnyLength) {
  const test::TempFolder folder;
  folder.write("1305031102.5.ply", marked(3));
  folder.write("1305031102.175304.ply", marked(1));
  folder.write("1305031102.25.ply", marked(2));
  folder.write("99999999999999999999999999.ply", marked(4));
  EXPECT_EQ(order_of(*open_clouds(folder.path(), {})), (std::vector<double>{1, 2, 3, 4}));
}

TEST(CloudFolder, AListOfTimesSaysWhichFilesAreFrames) {
  const test::TempFolder folder;
  folder.write("b.ply", marked(1));
  folder.write("a.ply", marked(2));
  folder.write("c.ply", marked(3));
  folder.write("timestamps.txt", "# time file\n7.5 b.ply\n7.75 a.ply\n");
  const auto recording = open_clouds(folder.path(), {});
  EXPECT_EQ(order_of(*recording), (std::vector<double>{1, 2}));
  Frame frame;
  recording->read(1, frame);
  EXPECT_EQ(frame.t_ns, 7'750'000'000);
  EXPECT_EQ(recording->period_ns(), 250'000'000);
  const auto other = folder.write("other.txt", "1 c.ply\n");
  EXPECT_EQ(order_of(*open_clouds(folder.path(), {.times = other})), std::vector<double>{3});
}

TEST(CloudFolder, BadListsAreErrorsWithTheirLine) {
  const test::TempFolder folder;
  folder.write("a.ply", marked(1));
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "names no frames"},
      {"# only this\n", "names no frames"},
      {"1 a.ply\n0.5 a.ply\n", ".txt:2: the time 0.5 lies before"},
      {"1305031102175304 a.ply\n", ".txt:1: a time in seconds below 9e9 is needed"},
      {"1 ../a.ply\n", "leads out of the folder"},
      {"1 /etc/passwd\n", "leads out of the folder"},
      {"1\n", ".txt:1: SECONDS FILE is needed"},
      {"1 a.ply", "cut off"},
      {"1 missing.ply\n", "missing.ply: cannot open"},
      {"1 .\n", "is a folder"},
  };
  for (const auto& [list, words] : cases) {
    folder.write("timestamps.txt", list);
    EXPECT_NE(error_text(folder.path()).find(words), std::string::npos)
        << list << ": " << error_text(folder.path());
  }
}

TEST(CloudFolder, WhatCannotBeOrderedOrReadIsAnErrorWithItsName) {
  const test::TempFolder folder;
  EXPECT_NE(error_text(folder.path()).find("no files that end in"), std::string::npos);
  EXPECT_NE(error_text(folder / "missing.ply").find("cannot open"), std::string::npos);
  folder.write("a.ply", marked(1));
  EXPECT_NE(error_text(folder.path()).find("a.ply: has no number"), std::string::npos);
  folder.write("a1.ply", marked(1));
  std::filesystem::remove(folder / "a.ply");
  folder.write("b01.pcd", marked(1));
  EXPECT_NE(error_text(folder.path()).find("b01.pcd: has the same number in its name as a1.ply"),
            std::string::npos);
  std::filesystem::remove(folder / "b01.pcd");
  folder.write("a2.ply", "");
  EXPECT_NE(error_text(folder.path()).find("a2.ply: is empty"), std::string::npos);
  std::filesystem::remove(folder / "a2.ply");
  ASSERT_EQ(::mkfifo((folder / "a3.ply").c_str(), 0600), 0);
  EXPECT_NE(error_text(folder.path()).find("a3.ply: is not a regular file"), std::string::npos);
  EXPECT_NE(error_text(folder.path(), {.period_ns = std::int64_t{1} << 62}).find("--period"),
            std::string::npos);
}

TEST(CloudFolder, AFrameHoldsNoMoreThanALogCan) {
  const test::TempFolder folder;
  const std::size_t count = kMaxFramePoints + 1;
  const auto file = folder.write(
      "big.ply", test::ply_header("binary_little_endian", count, "float") + std::string(17 * count, '\0'));
  EXPECT_NE(error_text(file).find("--stride"), std::string::npos) << error_text(file);
  EXPECT_EQ(error_text(file, {.stride = 2}), "none");
}

TEST(CloudFolder, RealCloudsAreReadToTheLastByte) {
  HALLWAY_DATA_OR_SKIP(clouds, "clouds");
  Frame frame;
  for (const auto& [name, count] : {std::pair{"room_scan1.pcd", 112586u}, {"room_scan2.pcd", 112624u}}) {
    open_clouds(clouds / name, {})->read(0, frame);
    EXPECT_EQ(frame.points.size() + frame.not_finite, count);
    for (const auto& point : frame.points) {
      for (const double value : point) ASSERT_LT(std::abs(value), 30.0) << "a room";
    }
  }
  // Pixels of a camera: wrong bytes would not give whole numbers.
  open_clouds(clouds / "kinect_table_learn0.pcd", {})->read(0, frame);
  EXPECT_EQ(frame.points.size() + frame.not_finite, 640u * 480u);
  EXPECT_GT(frame.points.size(), 100'000u);
  double last_row = 0.0;
  for (const auto& [x, y, z] : frame.points) {
    const double column = 525.0 * x / z + 319.5, row = 525.0 * y / z + 239.5;
    ASSERT_NEAR(column, std::round(column), 0.02);
    ASSERT_NEAR(row, std::round(row), 0.02);
    ASSERT_GE(std::round(row), last_row);
    last_row = std::round(row);
  }
}

TEST(Kind, ContentTellsThenTheName) {
  const test::TempFolder folder;
  EXPECT_EQ(tell_kind(folder.write("a.bin", "ply\nformat")), Kind::kClouds);
  EXPECT_EQ(tell_kind(folder.write("b.bin", "# .PCD v0.7")), Kind::kClouds);
  EXPECT_EQ(tell_kind(folder.write("c.csv", "#ROSBAG V2.0\n")), Kind::kBag);
  EXPECT_EQ(tell_kind(folder.write("d.bag", "")), Kind::kBag);
  EXPECT_EQ(tell_kind(folder.write("e.pcd", "VERSION 0.7")), Kind::kClouds);
  EXPECT_EQ(tell_kind(folder.write("f.csv", "iteration,x,y,z")), std::nullopt);
  EXPECT_EQ(tell_kind(folder / "missing"), std::nullopt);
  EXPECT_EQ(tell_kind(folder.path()), Kind::kClouds) << "e.pcd stands in it";
  folder.write("depth.txt", "");
  EXPECT_EQ(tell_kind(folder.path()), Kind::kTum);
  folder.write("run.json", "");
  EXPECT_EQ(tell_kind(folder.path()), std::nullopt);
  for (const Kind kind : {Kind::kClouds, Kind::kTum, Kind::kVictoriaPark, Kind::kBag}) {
    EXPECT_EQ(kind_named(kind_name(kind)), kind);
  }
  EXPECT_EQ(kind_named("csv"), std::nullopt);
}

TEST(Kind, FoldersOfTables) {
  const test::TempFolder folder;
  EXPECT_TRUE(test::error_of([&] { tell_kind(folder.path()); }));
  folder.write("observations.csv", "");
  EXPECT_EQ(tell_kind(folder.path()), std::nullopt);
  folder.write("scans.csv", "");
  EXPECT_EQ(tell_kind(folder.path()), Kind::kVictoriaPark);
}

}  // namespace
}  // namespace hallway::import
