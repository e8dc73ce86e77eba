// SPDX-License-Identifier: MIT
// Maps of faces in six degrees of freedom from end to end (slam_plane with dof=6): scored, recorded, the same however they are run.
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
using Json = nlohmann::ordered_json;
using Strings = std::vector<std::string>;

const Strings kFaceNoise{"--set", "sensor.eyes.noise_m=0.02",     "--set", "sensor.eyes.noise_angle_deg=0.3",
                         "--set", "sensor.eyes.noise_end_m=0.005"};

class SpatialMaps : public testing::Test {
 protected:
  fs::path out(const std::string& name) const { return folder_ / name; }

  /// `hallway run` of the rooms with a ramp between them.
  Ended run(const fs::path& out, const Strings& more) const {
    Strings arguments{"run", source_folder() / "maps" / "spatial_rooms.toml", "--out", out, "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return hallway(arguments);
  }

  Json run_with_noise(int seed) const {
    Strings more = kFaceNoise;
    more.insert(more.end(), {"--seed", std::to_string(seed), "--force", "--in-process"});
    const Ended ended = run(out("run"), more);
    EXPECT_EQ(ended.status, 0) << ended.err;
    return metrics(out("run"));
  }

  /// Whether each face is mapped, and none twice.
  static bool is_whole(const Json& planes) {
    return planes.at("final").at("walls_missing") == 0 && planes.at("final").at("duplicated") == 0;
  }

  static Json metrics(const fs::path& run) { return Json::parse(read_file(run / "metrics.json")); }

  static void expect_same(const fs::path& a, const fs::path& b) {
    for (const char* file :
         {"mapped_planes.csv", "submap_poses.csv", "submaps.csv", "matches.csv", "pose_errors.csv"})
      EXPECT_EQ(read_file(a / file), read_file(b / file)) << file << " of " << b;
    EXPECT_EQ(metrics(a).at("planes"), metrics(b).at("planes"));
  }

  TempFolder folder_;
};

TEST_F(SpatialMaps, WithoutNoiseAreExact) {
  const Ended ended = run(out("run"), {"--in-process"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Json found = metrics(out("run"));
  EXPECT_EQ(found.at("lost_iterations"), 0);
  const Json& planes = found.at("planes");
  EXPECT_EQ(planes.at("final").at("walls_mapped"), planes.at("walls_true"));
  EXPECT_EQ(planes.at("final").at("duplicated"), 0);
  EXPECT_LT(planes.at("position_m").at("max").get<double>(), 1e-6);
  EXPECT_LT(planes.at("final").at("offset_m").at("max").get<double>(), 1e-6);
  // Walls that the ramp stands against have an edge along it: corners of a rectangle about them are none.
  EXPECT_LT(planes.at("final").at("corner_m").at("max").get<double>(), 1e-6);
  EXPECT_EQ(planes.at("association_errors"), 0);
}

TEST_F(SpatialMaps, WithNoiseAreGoodToCentimetres) {
  // Neighbours in one plane, as the parts of a floor about a cabinet are, were taken for each other with seed 2.
  const Json found = run_with_noise(2);
  EXPECT_EQ(found.at("lost_iterations"), 0);
  const Json& planes = found.at("planes");
  EXPECT_TRUE(is_whole(planes));
  EXPECT_LE(planes.at("association_errors").get<double>(), 0.001 * planes.at("observations").get<double>());
  EXPECT_LT(planes.at("position_refitted_m").at("rms").get<double>(), 0.01);
  EXPECT_LT(planes.at("final").at("offset_m").at("rms").get<double>(), 0.01);
}

TEST_F(SpatialMaps, AreWholeForEverySeed) {
  const int seeds = long_mode() ? 20 : 0;
  int whole = 0;
  for (int seed = 1; seed <= seeds; ++seed) whole += is_whole(run_with_noise(seed).at("planes")) ? 1 : 0;
  EXPECT_GE(whole, 0.95 * seeds);
}

TEST_F(SpatialMaps, AreTheSameIsolatedInThisProcessAndReplayed) {
  Strings more = kFaceNoise;
  more.insert(more.end(), {"--steps", "200"});
  ASSERT_EQ(run(out("isolated"), more).status, 0);
  more.emplace_back("--in-process");
  ASSERT_EQ(run(out("here"), more).status, 0);
  expect_same(out("isolated"), out("here"));
  for (const fs::path& log : {out("isolated"), out("isolated") / "run.mcap"}) {
    const fs::path again = out("again-" + log.filename().string());
    const Ended ended = hallway({"replay", log, "--out", again, "--quiet"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    expect_same(out("isolated"), again);
  }
}

TEST_F(SpatialMaps, AreNotForTheThesisMode) {
  for (const Strings& how : {Strings{}, Strings{"--in-process"}}) {
    Strings more{"--set", "slam_plane.mode=thesis"};
    more.insert(more.end(), how.begin(), how.end());
    const Ended ended = run(out("run"), more);
    EXPECT_EQ(ended.status, 3) << ended.err;
    EXPECT_NE(ended.err.find("dof=6 goes with mode=relative alone"), std::string::npos) << ended.err;
    EXPECT_FALSE(fs::exists(out("run")));
  }
}

}  // namespace
}  // namespace hallway::test
