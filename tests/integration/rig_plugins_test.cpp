// SPDX-License-Identifier: MIT
//
// Plugins that take a rig, on the rig of the office.
#include <gtest/gtest.h>

#include <string>

#include <nlohmann/json.hpp>

#include "support/data.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {
namespace {

using RunJson = nlohmann::json;

class RigPlugins : public testing::Test {
 protected:
  /// The metrics of a run of 40 frames in the office with these sensors.
  RunJson metrics_of(const std::string& plugin, const std::string& sensors) {
    const std::string scenario =
        "schema = 'hallway.scenario/1'\nmap = '" + (source_folder() / "maps/office.map").string() +
        "'\nseed = 3\nsteps = 40\nperiod_s = 0.1\n[robot]\npath = 'round'\nloop_steps = 1010\n" + sensors +
        "[[plugin]]\nname = '" + plugin + "'\n";
    const std::string file = folder_.write("rig.toml", scenario);
    const Ended ended = hallway({"run", file, "--quiet", "--force", "--json", "--out", folder_ / "run"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    return ended.status == 0 ? RunJson::parse(ended.out).at("metrics") : RunJson();
  }

  TempFolder folder_;
};

const std::string kOdometry = "[sensor.odometry]\nkind = 'odometry'\nrate_hz = 50\n";
const std::string kWheels = "[sensor.wheels]\nkind = 'encoders'\nrate_hz = 100\n";
const std::string kImu = "[sensor.imu]\nkind = 'imu'\npreset = 'imu_mems'\n";
const std::string kLidar =
    "[sensor.lidar]\nkind = 'lidar'\npreset = 'lidar16'\nposition_m = [0.1, 0, 0.25]\n";

TEST_F(RigPlugins, DeadReckoningAddsUpWhatThereIs) {
  for (const std::string& sensors : {kOdometry, kWheels, kWheels + kImu, kOdometry + kWheels + kImu}) {
    const RunJson metrics = metrics_of("dead_reckoning", sensors);
    EXPECT_EQ(metrics.at("lost_iterations"), 0) << sensors;
    EXPECT_LT(metrics.at("position_final_m").get<double>(), 0.2) << sensors;
  }
}

TEST_F(RigPlugins, IcpFollowsALidarWithOdometry) {
  for (const std::string& more : {kOdometry + kImu, kOdometry}) {
    const RunJson metrics = metrics_of("icp", kLidar + more);
    EXPECT_LE(metrics.at("lost_iterations").get<int>(), 4) << more;  // the first frame has no scan
    EXPECT_LT(metrics.at("rpe").at("frame").at("translation_m").at("rmse").get<double>(), 0.02) << more;
  }
}

TEST_F(RigPlugins, WithoutASensorThatTheyTakeTheyAreNotActivated) {
  const std::string imu = "[sensor.imu]\nkind = 'imu'\nrate_hz = 100\n";
  const std::string file = folder_.write(
      "bare.toml", "schema = 'hallway.scenario/1'\nmap = '" + (source_folder() / "maps/office.map").string() +
                       "'\nsteps = 3\nperiod_s = 0.1\n[robot]\npath = 'round'\nloop_steps = 1010\n" + imu +
                       "[[plugin]]\nname = 'icp'\n");
  const Ended ended = hallway({"run", file, "--quiet", "--force", "--out", folder_ / "run"});
  EXPECT_NE(ended.status, 0);
  EXPECT_NE(ended.err.find("no sensor gives points"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace hallway::test
