// SPDX-License-Identifier: MIT
//
// Readings of whole runs against rig_oracle.py, which computes them from the scenario and the map by itself.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/text.hpp"
#include "support/data.hpp"
#include "support/long_mode.hpp"
#include "support/process.hpp"
#include "support/python.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using RigJson = nlohmann::json;

class Rig : public testing::Test {
 protected:
  void SetUp() override {
    const auto found = python_with_numpy();
    if (!found) GTEST_SKIP() << "no Python with numpy; HALLWAY_PYTHON names one";
    python_ = *found;
  }

  fs::path run(const std::string& scenario) {
    const std::string file = folder_.write("rig.toml", scenario);
    const fs::path out = folder_ / "run";
    const Ended ended = hallway({"run", file, "--quiet", "--force", "--out", out});
    EXPECT_EQ(ended.status, 0) << ended.err;
    return out;
  }

  /// What the oracle says of every n-th frame.
  RigJson look(const fs::path& out, int frames, int every, int rays) {
    std::string documents;
    for (int i = 0; i < frames; i += every) {
      const Ended ended = hallway({"log", "frame", out / "run.mcap", std::to_string(i), "--json"});
      EXPECT_EQ(ended.status, 0) << ended.err;
      documents += RigJson::parse(ended.out).dump() + "\n";
    }
    const fs::path lines = folder_.write("frames.jsonl", documents), said = folder_ / "said.json";
    const std::string command =
        "'" + python_ + "' -B '" + (source_folder() / "tests/integration/rig_oracle.py").string() + "' '" +
        out.string() + "' '" + lines.string() + "' " + std::to_string(rays) + " > '" + said.string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return RigJson::parse(read_file(said));
  }

  TempFolder folder_;
  std::string python_;
};

/// A lidar and an IMU without noise, mounted askew, on a path with corners.
std::string office_rig(int steps, const std::string& lidar) {
  return "map = \"" + (source_folder() / "maps/office.map").string() +
         "\"\nsteps = " + std::to_string(steps) +
         "\n[robot]\npath = \"round\"\nspeed_m_s = 1.5\n[sensor.lidar]\nkind = \"lidar\"\n" + lidar +
         "position_m = [0.15, -0.1, 0.2]\nyaw_deg = 30\npitch_deg = 4\nroll_deg = -3\n"
         "[sensor.imu]\nkind = \"imu\"\nrate_hz = 200\nposition_m = [-0.2, 0.3, 0.1]\nyaw_deg = "
         "-70\npitch_deg = 15\nroll_deg = 100\n"
         "[sensor.eyes]\nkind = \"points\"\nmax_range_m = 5\n[[plugin]]\nname = \"slam_point\"\n";
}

TEST_F(Rig, RangesAndInertialReadingsAreThoseOfAnIndependentComputation) {
  const int every = sized(3, 7);
  const std::string lidar =
      long_mode() ? "columns = 1800\nrings = 16\n" : "columns = 180\nstep_deg = 2\nrings = 8\n";
  const RigJson said =
      look(run(office_rig(sized(240, 700), lidar)), sized(240, 700), every, sized(5000, 1'000'000));
  if (long_mode()) std::printf("office: %s\n", said.dump().c_str());
  EXPECT_GE(said.at("rays").get<int>(), sized(4000, 900'000));
  EXPECT_EQ(said.at("unexplained"), 0) << said;
  EXPECT_LE(said.at("different").get<double>(), 1e-4 * said.at("rays").get<double>())
      << "rays that graze an edge";
  EXPECT_LT(said.at("worst_range_m").get<double>(), 1e-9) << said;
  EXPECT_GT(said.at("most_skew_m").get<double>(), 0.1) << "the motion during a scan is seen";
  EXPECT_GE(said.at("imu_samples").get<int>(), sized(80, 600));
  EXPECT_GT(said.at("most_angular").get<double>(), 0.5) << "corners are among them";
  EXPECT_LT(said.at("worst_angular").get<double>(), 1e-9) << said;
  EXPECT_LT(said.at("worst_force").get<double>(), 1e-9) << said;
}

TEST_F(Rig, ReadingsOnASmoothPathAreThoseOfAnIndependentComputation) {
  const std::string lidar = "columns = 90\nstep_deg = 4\nrings = 4\n";
  std::string scenario = office_rig(sized(200, 700), lidar);
  scenario.insert(scenario.find("speed_m_s"), "smooth = true\n");
  const RigJson said = look(run(scenario), sized(200, 700), sized(3, 7), sized(2000, 100'000));
  EXPECT_EQ(said.at("unexplained"), 0) << said;
  EXPECT_LT(said.at("worst_range_m").get<double>(), 1e-9) << said;
  EXPECT_GE(said.at("imu_samples").get<int>(), sized(60, 600));
  EXPECT_GT(said.at("most_angular").get<double>(), 0.5) << "corners are among them";
  EXPECT_LT(said.at("worst_angular").get<double>(), 1e-9) << said;
  EXPECT_LT(said.at("worst_force").get<double>(), 1e-9) << said;
}

/// A head that is turned in 24 steps while the robot drives, and eight heads that ping at once.
TEST_F(Rig, SweepsOfASonarAreThoseOfAnIndependentComputation) {
  std::string scenario = office_rig(sized(60, 700), "rings = 2\ncolumns = 36\nstep_deg = 10\n");
  scenario.insert(
      scenario.find("[sensor.eyes]"),
      "[sensor.head]\nkind = \"sonar\"\npings = 24\nping_step_deg = 15\nsweep_s = 1.2\nrate_hz = "
      "0.8\nmax_range_m = 10\nresolution_deg = 3\nposition_m = [0.05, 0, 0.1]\nyaw_deg = 10\n"
      "head_radius_m = 0.03\n[sensor.ring]\nkind = \"sonar\"\npings = 8\nfirst_deg = "
      "22.5\nping_step_deg = 45\ncone_deg = 25\nresolution_deg = 4\nmax_range_m = 6\nrate_hz = 2\n"
      "[material.'*']\necho_deg = 90\n");  // each hit is an echo
  const RigJson said = look(run(scenario), sized(60, 700), 1, 100);
  EXPECT_GE(said.at("pings").get<int>(), sized(150, 2000));
  EXPECT_LT(said.at("worst_ping_m").get<double>(), 1e-6) << said;
}

/// A lidar on a robot that stands at free places, in a map of Quake and in a building that is a mesh.
class StandingRig : public Rig {
 protected:
  void expect_ranges(const fs::path& map) {
    folder_.write("stand.csv", "t_ns,forward_m_s,angular_rad_s\n0,0,0\n");
    const std::string scan = long_mode() ? "columns = 16384\nstep_deg = 0.02\nrings = 16\n"
                                         : "columns = 360\nstep_deg = 1\nrings = 8\n";
    int rays = 0;
    for (int seed = 1; seed <= sized(1, 4); ++seed) {
      const fs::path out = run("map = \"" + map.string() + "\"\nsteps = 2\nseed = " + std::to_string(seed) +
                               "\n[robot]\nstart = \"free\"\nradius_m = 0.2\nbottom_m = 0.03\ntop_m = "
                               "0.5\ncommands = \"stand.csv\"\n"
                               "[robot.drive]\nkind = \"differential\"\n[sensor.lidar]\nkind = "
                               "\"lidar\"\nown_body = false\nlowest_deg = -60\nhighest_deg = 60\n" +
                               scan +
                               "position_m = [0.1, 0.05, 0.6]\nyaw_deg = 0.7\n[sensor.eyes]\nkind = "
                               "\"points\"\nmax_range_m = 5\n[[plugin]]\nname = \"slam_point\"\n");
      const RigJson said = look(out, 2, 1, 10'000'000);
      if (long_mode()) std::printf("%s, seed %d: %s\n", map.filename().c_str(), seed, said.dump().c_str());
      EXPECT_EQ(said.at("unexplained"), 0) << said;
      EXPECT_LE(said.at("different").get<double>(), 1e-3 * said.at("rays").get<double>())
          << "rays that graze an edge";
      EXPECT_LT(said.at("free").get<double>(), 0.5 * said.at("rays").get<double>()) << said;
      rays += said.at("rays").get<int>();
    }
    EXPECT_GE(rays, sized(2880, 1'000'000));
  }
};

TEST_F(StandingRig, RangesInAMapOfQuake) {
  HALLWAY_DATA_OR_SKIP(map, "maps/id1/e1m1.map");
  expect_ranges(map);
}

TEST_F(StandingRig, RangesInAModel) {
  HALLWAY_DATA_OR_SKIP(building, "models/buildings/willowgarage/meshes/willowgarage_visual.dae");
  const fs::path map = folder_ / "willowgarage.map";
  ASSERT_EQ(hallway({"import", building, "--copy", "--out", map}).status, 0);
  expect_ranges(map);
}

}  // namespace
}  // namespace hallway::test
