// SPDX-License-Identifier: MIT
// Maps of walls from end to end: recorded, scored and drawn, the same however they are run, and from points as well as from planes.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "support/data.hpp"
#include "support/long_mode.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Strings = std::vector<std::string>;

const Strings kNoise{"--set", "sensor.eyes.noise_m=0.02",     "--set", "sensor.eyes.noise_angle_deg=0.3",
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
  Strings more = kNoise;
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
  Strings more = kNoise;
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
