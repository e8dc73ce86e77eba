// SPDX-License-Identifier: MIT
// Maps of walls from end to end: recorded, scored and drawn, the same however they are run, and from points as well as from planes.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "support/data.hpp"
#include "support/long_mode.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Strings = std::vector<std::string>;

const Strings kWallNoise{"--set", "sensor.eyes.noise_m=0.02",     "--set", "sensor.eyes.noise_angle_deg=0.3",
                         "--set", "sensor.eyes.noise_end_m=0.005"};

class WallMaps : public testing::Test {
 protected:
  fs::path out(const std::string& name) const { return folder_ / name; }

  void run(const std::string& scenario, const fs::path& out, const Strings& more) {
    Strings arguments{"run", source_folder() / "maps" / (scenario + ".toml"), "--out", out, "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = hallway(arguments);
    ASSERT_EQ(ended.status, 0) << ended.err;
  }

  static Json planes(const fs::path& run) {
    return Json::parse(read_file(run / "metrics.json")).at("planes");
  }

  static void expect_same(const fs::path& a, const fs::path& b) {
    for (const char* file :
         {"mapped_planes.csv", "submap_poses.csv", "submaps.csv", "matches.csv", "pose_errors.csv"})
      EXPECT_EQ(read_file(a / file), read_file(b / file)) << file << " of " << b;
    EXPECT_EQ(planes(a), planes(b));
  }

  /// What is asked of a map that points gave.
  static void expect_good(const Json& planes) {
    const Json& map = planes.at("final");
    EXPECT_GE(map.at("walls_mapped").get<double>(), 0.95 * planes.at("walls_true").get<double>());
    EXPECT_LE(map.at("corner_m").at("mean").get<double>(), 0.08);
  }

  TempFolder folder_;
};

TEST_F(WallMaps, AreTheSameIsolatedInThisProcessAndReplayed) {
  Strings more = kWallNoise;
  more.insert(more.end(), {"--steps", "250"});
  run("hallway", out("isolated"), more);
  more.emplace_back("--in-process");
  run("hallway", out("here"), more);
  expect_same(out("isolated"), out("here"));
  for (const fs::path& log : {out("isolated"), out("isolated") / "run.mcap"}) {
    const fs::path again = out("again-" + log.filename().string());
    const Ended ended = hallway({"replay", log, "--out", again, "--quiet"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    expect_same(out("isolated"), again);
  }
}

TEST_F(WallMaps, AreScored) {
  Strings more = kWallNoise;
  more.insert(more.end(), {"--steps", "250", "--in-process"});
  run("hallway", out("run"), more);
  const Json found = planes(out("run"));
  EXPECT_GT(found.at("walls_true").get<int>(), 8);
  EXPECT_EQ(found.at("final").at("walls_mapped"), found.at("walls_true"));
  EXPECT_EQ(found.at("final").at("aligned_by"), "corners");
  EXPECT_LT(found.at("final").at("corner_m").at("mean").get<double>(), 0.01);
  EXPECT_LT(found.at("final").at("offset_m").at("mean").get<double>(), 0.01);
  EXPECT_GT(found.at("final").at("extent_iou").at("mean").get<double>(), 0.95);
  EXPECT_EQ(found.at("position_m").at("count"), 250);
}

/// By how much values change from the first to the last, and half of the 95 % interval about that: the least-squares line through the means of 20 blocks,
/// long enough to be independent of each other.
std::pair<double, double> change_of(const std::vector<double>& values) {
  constexpr std::size_t kBlocks = 20;
  constexpr double kStudent = 2.101;  // of 18 degrees of freedom
  const std::size_t size = values.size() / kBlocks;
  std::vector<double> means;
  for (std::size_t k = 0; k < kBlocks; ++k) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(k * size);
    means.push_back(std::accumulate(first, first + static_cast<std::ptrdiff_t>(size), 0.0) /
                    static_cast<double>(size));
  }
  const double mean = std::accumulate(means.begin(), means.end(), 0.0) / kBlocks;
  const double middle = 0.5 * (kBlocks - 1);
  double spread = 0.0, slope = 0.0, rest = 0.0;
  for (std::size_t k = 0; k < kBlocks; ++k) {
    const double at = static_cast<double>(k) - middle;
    spread += at * at;
    slope += at * (means[k] - mean);
  }
  slope /= spread;
  for (std::size_t k = 0; k < kBlocks; ++k)
    rest += std::pow(means[k] - mean - slope * (static_cast<double>(k) - middle), 2) / (kBlocks - 2);
  return {kBlocks * slope, kBlocks * kStudent * std::sqrt(rest / spread)};
}

TEST_F(WallMaps, DoNotDrift) {
  for (const char* mode : {"relative", "thesis"}) {
    Strings more = kWallNoise;
    more.insert(more.end(), {"--steps", std::to_string(sized(3000, 20000)), "--in-process", "--force",
                             "--set", std::string("slam_plane.mode=") + mode});
    run("four_planes", out("run"), more);
    std::istringstream rows(read_file(out("run") / "pose_errors.csv"));
    std::string row;
    std::getline(rows, row);
    std::vector<double> errors;
    while (std::getline(rows, row)) errors.push_back(std::stod(row.substr(row.find(',') + 1)));
    ASSERT_GE(errors.size(), 2000u);
    const auto [change, half] = change_of(errors);
    EXPECT_LE(std::abs(change) + half, long_mode() ? 0.002 : 0.02) << mode;
  }
}

TEST_F(WallMaps, ArePlacedAnewAtTheEnd) {
  run("hallway_return", out("run"),
      {"--set", "sensor.eyes.noise_m=0.02", "--set", "sensor.eyes.noise_end_m=0.005", "--set",
       "sensor.eyes.noise_angle_deg=0.3", "--in-process"});
  const Json found = planes(out("run"));
  EXPECT_GE(found.at("position_refitted_m").at("count").get<double>(),
            0.9 * found.at("position_m").at("count").get<double>());
  EXPECT_LT(found.at("position_refitted_m").at("rms"), found.at("position_m").at("rms"));
}

TEST_F(WallMaps, GoOnThroughAGapWhereTheRobotLooks) {
  run("motion_model", out("run"), {"--in-process"});
  const Json found = planes(out("run"));
  EXPECT_LT(found.at("position_m").at("rms"), 0.001);
  EXPECT_LT(found.at("position_refitted_m").at("rms"), 0.001);
  EXPECT_EQ(found.at("final").at("walls_missing"), 0);
  EXPECT_EQ(found.at("final").at("duplicated"), 0);
}

TEST_F(WallMaps, ComeFromPointsToo) {
  run("em_corridor", out("run"), {"--steps", "160"});
  EXPECT_TRUE(fs::exists(out("run") / "true_walls.csv"));
  EXPECT_TRUE(fs::exists(out("run") / "found_planes.csv"));
  EXPECT_GT(planes(out("run")).at("walls_true").get<int>(), 8);
  expect_good(planes(out("run")));
  const Ended replayed = hallway({"replay", out("run") / "run.mcap", "--out", out("again"), "--quiet"});
  ASSERT_EQ(replayed.status, 0) << replayed.err;
  expect_same(out("run"), out("again"));
  const Ended drawn = hallway(
      {"render", out("run"), "--view", "panels", "--size", "640x480", "--out", folder_ / "panels.png"});
  EXPECT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_EQ(read_file(folder_ / "panels.png").substr(1, 3), "PNG");
}

TEST_F(WallMaps, PanelsAreOfRuns) {
  const Ended refused = hallway({"render", source_folder() / "maps/em_corridor.map", "--view", "panels",
                                 "--out", folder_ / "panels.png"});
  EXPECT_EQ(refused.status, 2) << refused.err;
}

TEST_F(WallMaps, FromPointsAreGoodForEverySeed) {
  const int seeds = long_mode() ? 20 : 0;
  for (const char* scenario : {"em_corridor", "em_floor"}) {
    for (int seed = 1; seed <= seeds; ++seed) {
      SCOPED_TRACE(std::string(scenario) + ", seed " + std::to_string(seed));
      run(scenario, out("run"), {"--seed", std::to_string(seed), "--force", "--in-process"});
      expect_good(planes(out("run")));
      EXPECT_EQ(Json::parse(read_file(out("run") / "metrics.json")).at("lost_iterations"), 0);
    }
  }
}

}  // namespace
}  // namespace hallway::test
