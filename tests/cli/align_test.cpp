// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "support/data.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Points of a floor, two walls and a box with some millimetres of noise, placed so that `x` and `yaw` bring them back.
std::string corner_csv(double x, double yaw, double from) {
  std::string text = "x,y,z\n";
  int count = 0;
  const auto noise = [&count] { return 0.003 * std::sin(7.0 * ++count); };
  const auto add = [&](double px, double py, double pz) {
    const double dx = px - x + noise(), dy = py + noise();
    text += std::to_string(std::cos(yaw) * dx + std::sin(yaw) * dy) + "," +
            std::to_string(-std::sin(yaw) * dx + std::cos(yaw) * dy) + "," + std::to_string(pz + noise()) +
            "\n";
  };
  for (double u = from; u < 4.0; u += 0.1) {
    for (double v = from; v < 3.0; v += 0.1) {
      add(u, v, 0);
      add(u, 0, v);
      add(0, v, u);
      add(1 + 0.2 * u, 1, 0.3 * v);
    }
  }
  return text;
}

TEST(Align, FindsTheMotionAndWritesTheMovedCloud) {
  const TempFolder folder;
  folder.write("a.csv", corner_csv(0, 0, 0.0));
  folder.write("b.csv", corner_csv(0.2, 0.1, 0.05));
  const Ended ended = hallway({"align", folder / "a.csv", folder / "b.csv", "--json", "--out",
                               folder / "moved.ply", "--picture", folder / "both.png"});
  ASSERT_EQ(ended.status, 0) << ended.err << ended.out;
  const Json found = Json::parse(ended.out);
  EXPECT_EQ(found.at("schema"), "hallway.align/1");
  EXPECT_EQ(found.at("outcome"), "converged");
  EXPECT_NEAR(found.at("T_a_b").at("position_m").at(0).get<double>(), 0.2, 0.005);
  EXPECT_NEAR(found.at("T_a_b").at("position_m").at(1).get<double>(), 0.0, 0.005);
  EXPECT_NEAR(found.at("T_a_b").at("yaw_pitch_roll_deg").at(0).get<double>(), 0.1 * 180 / M_PI, 0.1);
  EXPECT_NEAR(found.at("T_a_b").at("matrix").at(1).at(0).get<double>(), std::sin(0.1), 0.002);
  EXPECT_GT(found.at("overlap").get<double>(), 0.95);
  EXPECT_LT(found.at("residual_m").get<double>(), 0.01);
  EXPECT_GT(fs::file_size(folder / "both.png"), 1000u);
  // The moved cloud fits as it stands.
  const Ended again = hallway({"align", folder / "a.csv", folder / "moved.ply", "--json"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_NEAR(Json::parse(again.out).at("T_a_b").at("position_m").at(0).get<double>(), 0.0, 0.002);
}

TEST(Align, TextSaysWhatJsonSays) {
  const TempFolder folder;
  folder.write("a.csv", corner_csv(0, 0, 0.0));
  const Ended ended =
      hallway({"align", folder / "a.csv", folder / "a.csv", "--guess", "0.05, 0, 0, 1, 0, 0"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  for (const char* part : {"converged", "T_a_b", "yaw pitch roll", "residual", "overlap 100.0 %"})
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
}

/// The same points, as another form of file.
std::string as_obj(const std::string& csv) {
  std::string text;
  for (std::size_t at = csv.find('\n') + 1; at < csv.size(); at = csv.find('\n', at) + 1)
    text += "v " + csv.substr(at, csv.find('\n', at) + 1 - at);
  std::replace(text.begin(), text.end(), ',', ' ');
  return text;
}

TEST(Align, TakesEveryFileThatPlanesTakes) {
  const TempFolder folder;
  const std::string points = corner_csv(0, 0, 0.0);
  const std::string a = folder.write("a.csv", points);
  const std::string renamed =
      folder.write("c.csv", "px,py,pz\nnan,0,0\n" + points.substr(points.find('\n') + 1));
  const auto read = [](const std::vector<std::string>& arguments) {
    const Ended ended = hallway(arguments);
    EXPECT_EQ(ended.status, 0) << ended.err << ended.out;
    return ended.status == 0 ? Json::parse(ended.out).at("b").at("points") : Json();
  };
  const Json count = read({"align", a, a, "--json"});
  EXPECT_EQ(read({"align", a, folder.write("b.obj", as_obj(points)), "--json"}), count);
  EXPECT_EQ(read({"align", renamed, renamed, "--columns", "px,py,pz", "--json"}), count);
  EXPECT_EQ(hallway({"align", a, folder.write("d.png", "\x89PNG\r\n\x1a\n")}).status, 2)
      << "a depth image needs its camera";
}

TEST(Align, CloudsThatDoNotFitHaveStatusOneAndNoFile) {
  const TempFolder folder;
  folder.write("a.csv", corner_csv(0, 0, 0.0));
  folder.write("far.csv", "x,y,z\n900,0,0\n901,0,0\n900,1,0\n900,0,1\n");
  folder.write("one.csv", "x,y,z\n1,2,3\n");
  folder.write("none.csv", "x,y,z\n");
  for (const char* b : {"far.csv", "one.csv", "none.csv"}) {
    const Ended ended =
        hallway({"align", folder / "a.csv", folder / b, "--json", "--out", folder / "moved.ply"});
    EXPECT_EQ(ended.status, 1) << b << ended.err;
    EXPECT_FALSE(Json::parse(ended.out).at("converged").get<bool>()) << b;
    EXPECT_FALSE(fs::exists(folder / "moved.ply"));
  }
}

TEST(Align, BadFilesAndOptions) {
  const TempFolder folder;
  folder.write("a.csv", corner_csv(0, 0, 0.0));
  folder.write("headless.csv", "1,2,3\n");
  folder.write("bad.ply", "ply\nformat ascii 1.0\nelement vertex 9\n");
  folder.write("word.csv", "x,y,z\n1,2,three\n");
  const std::string a = folder / "a.csv";
  for (const std::string& b :
       {std::string(folder / "headless.csv"), std::string(folder / "bad.ply"),
        std::string(folder / "word.csv"), std::string(folder / "absent.pcd"), folder.path().string()}) {
    const Ended ended = hallway({"align", a, b, "--json"});
    EXPECT_EQ(ended.status, 3) << b << ended.out;
    EXPECT_NE(ended.out.find(fs::path(b).filename().string()), std::string::npos) << ended.out;
  }
  EXPECT_EQ(hallway({"align", a}).status, 2);
  EXPECT_EQ(hallway({"align", a, a, "--guess", "1 2 3"}).status, 2);
  EXPECT_EQ(hallway({"align", a, a, "--guess", "1 2 3 4 5 six"}).status, 2);
  EXPECT_EQ(hallway({"align", a, a, "--method", "ndt"}).status, 2);
  EXPECT_EQ(hallway({"align", a, a, "--max-distance", "0"}).status, 2);
}

/// Two scans of one room from two places, and what the Point Cloud Library makes of them: docs/accuracy.md.
TEST(Align, RoomScansAgreeWithAPeer) {
  HALLWAY_DATA_OR_SKIP(clouds, "clouds");
  const Ended ended = hallway({"align", clouds / "room_scan1.pcd", clouds / "room_scan2.pcd", "--guess",
                               "1.79387 0.720047 0 39.7117 0 0", "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Json T = Json::parse(ended.out).at("T_a_b");
  const double expected_m[] = {1.9723, 0.0575, 0.0259};
  const double expected_deg[] = {40.8355, 1.4452, 0.1452};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(T.at("position_m").at(i).get<double>(), expected_m[i], 0.02) << i;
    EXPECT_NEAR(T.at("yaw_pitch_roll_deg").at(i).get<double>(), expected_deg[i], 0.2) << i;
  }
}

TEST(Align, WhatIsWrittenReplacesNoInput) {
  const TempFolder folder;
  std::string points = "x,y,z\n";
  for (int i = 0; i < 200; ++i)
    points += std::to_string(i % 7) + "," + std::to_string(i % 11) + "," + std::to_string(i % 13) + "\n";
  const std::string a = folder.write("a.csv", points), b = folder.write("b.csv", points);
  for (const std::string& out : std::vector<std::string>{a, b, folder / "c.txt"}) {
    EXPECT_EQ(hallway({"align", a, b, "--out", out}).status, 2) << out;
    EXPECT_EQ(read_file(a), points);
    EXPECT_EQ(read_file(b), points);
  }
  EXPECT_EQ(hallway({"align", a, b, "--picture", a}).status, 2);
}

}  // namespace
}  // namespace hallway::test
