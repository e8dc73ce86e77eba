// SPDX-License-Identifier: MIT
// Clouds that are none, hold no plane or lie about themselves, as `hallway planes` and `hallway align` take them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "support/gray_png.hpp"
#include "support/process.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHeader = "x,y,z\n";

std::string row(double x, double y, double z) {
  char text[128];
  std::snprintf(text, sizeof text, "%.17g,%.17g,%.17g\n", x, y, z);
  return text;
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

/// A rough square of 400 points, `scale` metres between them, `far` metres away along each axis.
std::string square(double scale, double far) {
  std::string text;
  for (int i = 0; i < 400; ++i) {
    const double across = 0.02 * std::sin(12.9898 * i + 4.0 * std::cos(78.233 * i));
    text += row(far + scale * (i % 20), far + scale * (0.3 * (i % 20) + across), far + scale * (i / 20));
  }
  return text;
}

/// Points of a line; in decimals no three of them lie exactly on one.
std::string line() {
  std::string text;
  for (int i = 0; i < 300; ++i) text += row(0.1 * i, 0.2 * i, 1.0 - 0.3 * i);
  return text;
}

const std::string kNoPoints = "nan,0,0\n1,inf,2\n0,0,-inf\n";

/// Clouds in which no plane is.
std::vector<std::pair<const char*, std::string>> without_plane() {
  return {{"empty", ""},
          {"one", row(1, 2, 3)},
          {"two", row(1, 2, 3) + row(3, 2, 1)},
          {"equal", repeated(row(0.1, 0.2, 0.3), 500)},
          {"line", line()},
          {"not_finite", kNoPoints},
          {"far_apart", row(1e9, 0, 0) + row(0, -1e9, 0) + row(0, 0, 1e9) + row(-1e9, -1e9, 1e9)},
          {"largest", repeated(row(1e308, -1e308, 1e308) + row(-1e308, 1e308, -1e308) + row(5, 6, 7), 20)}};
}

/// Clouds of one plane each, with the number of its points.
std::vector<std::pair<std::string, int>> of_one_plane() {
  return {{square(0.05, 0.0), 400},
          {square(0.05, 1e6), 400},
          {square(1e9, 1e9), 400},
          {square(1e-6, 0.0), 400},
          {repeated(square(0.05, 0.0), 3), 1200},
          {kNoPoints + square(0.05, 0.0) + kNoPoints, 400}};
}

/// What `hallway planes` says, with files and a picture in `out` if that is not empty.
nlohmann::ordered_json planes_of(const std::string& cloud, const std::string& plugin, const fs::path& out) {
  std::vector<std::string> arguments{"planes", cloud, "--plugin", plugin, "--json"};
  if (!out.empty()) arguments.insert(arguments.end(), {"--out", out});
  const Ended ended = hallway(arguments);
  EXPECT_EQ(ended.status, 0) << plugin << " " << cloud << ended.err << ended.out;
  EXPECT_TRUE(out.empty() || fs::exists(out / "planes.png")) << plugin << " " << cloud;
  return ended.status == 0 ? nlohmann::ordered_json::parse(ended.out)
                           : nlohmann::ordered_json{{"planes", nlohmann::ordered_json::array()}};
}

class BadClouds : public testing::Test {
 protected:
  /// A file of rows.
  std::string csv(const std::string& name, const std::string& rows) {
    return folder_.write(name + ".csv", kHeader + rows);
  }
  Ended align(const std::string& a, const std::string& b) {
    return hallway(
        {"align", a, b, "--json", "--out", folder_ / "moved.ply", "--picture", folder_ / "both.png"});
  }
  const TempFolder folder_;
};

TEST_F(BadClouds, WithoutAPlaneHaveNone) {
  for (const auto& [name, rows] : without_plane()) {
    const std::string cloud = csv(name, rows);
    EXPECT_EQ(planes_of(cloud, "em", folder_ / name).at("planes").size(), 0u) << name;
    for (const char* plugin : {"em1", "em2"})
      EXPECT_EQ(planes_of(cloud, plugin, {}).at("planes").size(), 0u) << plugin << " " << name;
  }
}

TEST_F(BadClouds, AreCountedByWhatIsNotFinite) {
  const nlohmann::ordered_json found = planes_of(csv("not_finite", kNoPoints), "em", {});
  EXPECT_EQ(found.at("rows"), 3);
  EXPECT_EQ(found.at("points"), 0);
  EXPECT_EQ(found.at("not_finite"), 3);
}

TEST_F(BadClouds, OfAnySizeAndPlaceHaveTheirPlane) {
  for (const auto& [rows, points] : of_one_plane()) {
    const nlohmann::ordered_json found = planes_of(csv("plane", rows), "em", {});
    ASSERT_EQ(found.at("planes").size(), 1u) << rows.substr(0, 200);
    EXPECT_EQ(found.at("planes").at(0).at("points"), points) << rows.substr(0, 200);
  }
}

TEST_F(BadClouds, AlignWithNothingAndLeaveNoFile) {
  const std::string good = csv("good", square(0.05, 0.0));
  for (const auto& [name, rows] : without_plane()) {
    const std::string bad = csv(name, rows);
    for (const auto& [a, b] : {std::pair(good, bad), std::pair(bad, good), std::pair(bad, bad)}) {
      const Ended ended = align(a, b);
      EXPECT_EQ(ended.status, 1) << a << " " << b << ended.err;
      EXPECT_FALSE(nlohmann::ordered_json::parse(ended.out).at("converged").get<bool>()) << a << " " << b;
      EXPECT_FALSE(fs::exists(folder_ / "moved.ply"));
      EXPECT_FALSE(fs::exists(folder_ / "both.png"));
    }
  }
}

/// Files that say one thing and hold another.
std::vector<std::pair<const char*, std::string>> lying() {
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex ";
  const std::string xyz = "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  const std::string binary = "ply\nformat binary_little_endian 1.0\nelement vertex ";
  const std::string pcd = "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
  const std::string view = "HEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n";
  const std::string three = "0 0 1\n1 0 1\n0 1 1\n";
  return {{"more.ply", ply + "4" + xyz + three},
          {"huge.ply", ply + "4611686018427387904" + xyz + three},
          {"negative.ply", ply + "-3" + xyz + three},
          {"binary.ply", binary + "3" + xyz + "0123456789"},
          {"huge_binary.ply", binary + "4000000000" + xyz + "0123456789"},
          {"no_x.ply", ply + "3\nproperty float y\nproperty float z\nend_header\n0 1\n0 1\n1 1\n"},
          {"more.pcd", pcd + "WIDTH 4\n" + view + "POINTS 4\nDATA ascii\n" + three},
          {"two_counts.pcd", pcd + "WIDTH 3\n" + view + "POINTS 4\nDATA ascii\n" + three},
          {"huge.pcd", pcd + "WIDTH 4000000000\n" + view + "POINTS 4000000000\nDATA binary\n" + three},
          {"compressed.pcd",
           pcd + "WIDTH 3\n" + view + "POINTS 3\nDATA binary_compressed\n\xff\xff\xff\xff" + three},
          {"no_numbers.csv", "x,y,z\none,two,three\n"},
          {"no_header.csv", "0,0,1\n1,0,1\n"},
          {"cut.png", gray_png(40, 40, std::vector<std::uint16_t>(1600, 2000)).substr(0, 60)},
          {"nothing.ply", ""}};
}

TEST_F(BadClouds, ThatLieAreRefusedByName) {
  const std::string good = csv("good", square(0.05, 0.0));
  for (const auto& [name, content] : lying()) {
    const std::string bad = folder_.write(name, content);
    const Ended planes = hallway({"planes", bad, "--plugin", "em", "--intrinsics", "40,40,20,20", "--json"});
    EXPECT_EQ(planes.status, 3) << name << planes.out;
    EXPECT_NE(planes.out.find(name), std::string::npos) << planes.out;
    const Ended aligned = hallway({"align", good, bad, "--intrinsics", "40,40,20,20", "--json"});
    EXPECT_EQ(aligned.status, 3) << name << aligned.out;
    EXPECT_NE(aligned.out.find(name), std::string::npos) << aligned.out;
  }
}

}  // namespace
}  // namespace hallway::test
