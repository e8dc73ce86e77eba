// SPDX-License-Identifier: MIT
// Logs in the layouts of other programs, read by check_layouts.py, and back.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "base/file.hpp"
#include "base/text.hpp"
#include "support/data.hpp"
#include "support/process.hpp"
#include "support/python.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A robot with many sensors that goes along two walls of a room and turns in between.
constexpr const char* kRoom = R"(new points=2
room from 0,0 to 8,6 height=2.7 name=hall
start at 1,1,0.5 heading=0
path round 1,1,0.5;6,1,0.5;6,4,0.5;1,4,0.5 corner_radius=0.5
)";
constexpr const char* kRig = R"(schema = "hallway.scenario/1"
map = "room.map"
steps = 26
[robot]
path = "round"
speed_m_s = 2.5
[sensor.eyes]
kind = "points"
max_range_m = 12
[sensor.lidar]
kind = "lidar"
rings = 4
columns = 90
step_deg = 4
rate_hz = 10
dropout = 0.1
position_m = [0.1, 0, 0.2]
yaw_deg = 20
pitch_deg = 5
[sensor.imu]
kind = "imu"
preset = "imu_mems"
position_m = [-0.05, 0.1, 0]
[sensor.wheels]
kind = "encoders"
rate_hz = 20
[sensor.odometry]
kind = "odometry"
rate_hz = 20
)";

class LogLayouts : public testing::Test {
 protected:
  void SetUp() override {
    const auto python = python_with_numpy();
    if (!python) GTEST_SKIP() << "no Python with numpy (HALLWAY_PYTHON names one)";
    python_ = *python;
    run_rig(kRig);
  }
  void run_rig(const std::string& scenario) {
    folder_.write("room.hwe", kRoom);
    folder_.write("rig.toml", scenario);
    Ended ended = hallway({"edit", path("room.map"), "-f", path("room.hwe")});
    ASSERT_EQ(ended.status, 0) << ended.err;
    ended = hallway(
        {"run", path("rig.toml"), "--plugin", "slam_point", "--out", path("run"), "--quiet", "--force"});
    ASSERT_EQ(ended.status, 0) << ended.err;
  }
  std::string path(const std::string& name) const { return folder_ / name; }
  /// Converts to a new place. @return its warnings
  std::vector<std::string> convert(const std::string& from, const std::string& to,
                                   const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"log", "convert", path(from), "--out", path(to), "--json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ended ended = hallway(arguments);
    EXPECT_EQ(ended.status, 0) << ended.err;
    if (ended.status != 0) return {};
    return Json::parse(ended.out).at("warnings").get<std::vector<std::string>>();
  }
  void check(const std::string& what, const std::string& written) const {
    const fs::path script = source_folder() / "tests/cli/check_layouts.py";
    EXPECT_EQ(run_python(python_, {script, hallway_program(), path("run"), path(written), what}), 0) << what;
  }
  void expect_refusal(const std::vector<std::string>& options, int status, const std::string& words,
                      const std::string& out = "none") const {
    std::vector<std::string> arguments{"log", "convert", path("run"), "--out", path(out)};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ended ended = hallway(arguments);
    EXPECT_EQ(ended.status, status) << words << ": " << ended.err;
    EXPECT_NE(ended.err.find(words), std::string::npos) << ended.err;
    EXPECT_FALSE(fs::exists(path(out))) << "nothing is left";
  }

  TempFolder folder_;
  std::string python_;
};

TEST_F(LogLayouts, KittiAndBack) {
  EXPECT_TRUE(convert("run", "kitti", {"--to", "kitti", "--sensor", "lidar"}).empty());
  check("kitti", "kitti");
  convert("kitti", "again.mcap", {});
  check("again-kitti", "again.mcap");
  convert("again.mcap", "twice", {"--to", "kitti"});
  check("kitti", "twice");
}

TEST_F(LogLayouts, DeskewedPointsAreOnTheWalls) {
  const auto warnings = convert("run", "kitti", {"--to", "kitti", "--deskew"});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings.front().find("at most 0.005 s apart"), std::string::npos) << warnings.front();
  check("deskewed", "kitti");
}

TEST_F(LogLayouts, PcdImuFolderAndBack) {
  EXPECT_TRUE(convert("run", "pcd", {"--to", "pcd-imu"}).empty());
  check("pcd-imu", "pcd");
  EXPECT_TRUE(convert("pcd", "again.mcap", {}).empty());
  check("again", "again.mcap");
  convert("again.mcap", "kitti", {"--to", "kitti", "--deskew"});
  for (const auto& entry : fs::directory_iterator(path("pcd"))) {
    const fs::path name = entry.path().filename();
    if (name == "truth.tum") continue;  // poses of the clouds' last points are further ones
    convert("again.mcap", "twice_" + name.string(), {"--to", "pcd-imu"});
    EXPECT_EQ(read_file(fs::path(path("twice_" + name.string())) / name), read_file(entry.path())) << name;
  }
}

TEST_F(LogLayouts, EurocAndBack) {
  EXPECT_TRUE(convert("run", "euroc", {"--to", "euroc"}).empty());
  check("euroc", "euroc");
  convert("euroc", "again.mcap", {});
  check("again-euroc", "again.mcap");
  convert("again.mcap", "twice", {"--to", "euroc"});
  for (const char* file : {"mav0/imu0/data.csv", "mav0/imu0/sensor.yaml"})
    EXPECT_EQ(read_file(fs::path(path("twice")) / file), read_file(fs::path(path("euroc")) / file)) << file;
}

TEST_F(LogLayouts, TablesNameWhatReturnsAreOf) {
  EXPECT_FALSE(fs::exists(fs::path(path("tables")) / "labels.csv"));
  std::string labelled = kRig;
  labelled.insert(labelled.find("dropout = 0.1"), "labels = true\n");
  run_rig(labelled);
  convert("run", "labelled", {"--to", "tables"});
  const std::string labels = read_file(path("labelled/labels.csv"));
  EXPECT_TRUE(labels.starts_with("id,thing,material,mover\n0,\"entity 1, brush ")) << labels;
  const auto last = labels.rfind('\n', labels.size() - 2);
  const auto own = std::stoul(labels.substr(last + 1));
  EXPECT_EQ(labels.substr(last + 1), std::to_string(own) + ",\"robot\",\"\",\"robot\"\n");
  std::istringstream rows(read_file(path("labelled/lidar.csv")));
  std::string row;
  std::getline(rows, row);
  EXPECT_TRUE(row.ends_with(",layer,true_range_m,true_label")) << row;
  int returns = 0, others = 0;
  while (std::getline(rows, row)) {
    const auto fields = split(row, ',');
    ASSERT_EQ(fields.size(), 10u) << row;
    const bool is_return = !fields[5].empty() && fields[5] != "inf";
    EXPECT_EQ(is_return, !fields[9].empty()) << row;
    if (is_return) {
      EXPECT_LT(std::stoul(std::string(fields[9])), own) << row;
    }
    (is_return ? returns : others) += 1;
  }
  EXPECT_GT(returns, 5000);
  EXPECT_GT(others, 500) << "drop-outs";
  const Ended replayed = hallway({"replay", path("run/run.mcap"), "--plugin", "slam_point", "--out",
                                  path("replayed"), "--quiet", "--force"});
  ASSERT_EQ(replayed.status, 0) << replayed.err;
  convert("replayed", "again", {"--to", "tables"});
  EXPECT_EQ(read_file(path("again/labels.csv")), labels);
  EXPECT_EQ(read_file(path("again/lidar.csv")), read_file(path("labelled/lidar.csv")));
}

TEST_F(LogLayouts, TablesOfEverySensor) {
  convert("run", "tables", {"--to", "tables"});
  check("tables", "tables");
  convert("run", "one", {"--to", "tables", "--sensor", "imu"});
  EXPECT_FALSE(fs::exists(path("one/lidar.csv")));
  EXPECT_EQ(read_file(path("one/imu.csv")), read_file(path("tables/imu.csv")));
}

TEST_F(LogLayouts, TrueTrajectory) {
  convert("run", "truth.tum", {"--to", "tum"});
  convert("run", "lidar.tum", {"--to", "tum", "--sensor", "lidar"});
  const auto lines = [&](const char* name) {
    const std::string text = read_file(path(name));
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(lines("truth.tum"), 1 + 26);
  EXPECT_EQ(lines("lidar.tum"), 1 + 25) << "a pose for each scan";
}

TEST_F(LogLayouts, AreReplayed) {
  convert("run", "pcd", {"--to", "pcd-imu"});
  const Ended ended = hallway({"replay", path("pcd"), "--plugin", "icp", "--out", path("replay"), "--quiet"});
  EXPECT_EQ(ended.status, 0) << ended.err;
}

TEST_F(LogLayouts, BadOptionsHaveACause) {
  expect_refusal({"--to", "kitti", "--sensor", "radar"}, 2, "no sensor radar; it has eyes (points), lidar");
  expect_refusal({"--to", "kitti", "--sensor", "imu"}, 2, "gives imu");
  expect_refusal({"--to", "euroc", "--sensor", "lidar"}, 2, "gives range_scan");
  expect_refusal({"--to", "pcd-imu", "--imu", "wheels"}, 2, "gives encoder");
  expect_refusal({"--to", "tables", "--sensor", "radar"}, 2, "no sensor radar");
  expect_refusal({"--sensor", "lidar"}, 2, "--sensor does not belong to --to csv");
  expect_refusal({"--to", "tables", "--imu", "imu"}, 2, "--imu does not belong to --to tables");
  expect_refusal({"--to", "euroc", "--deskew"}, 2, "--deskew does not belong to --to euroc");
  expect_refusal({"--to", "kitti"}, 2, ".mcap", "none.mcap");
  expect_refusal({"--to", "mcap"}, 2, "ends in .mcap");
  expect_refusal({"--to", "nuscenes"}, 2, "nuscenes");
  convert("run", "kitti", {"--to", "kitti"});
  const Ended ended =
      hallway({"log", "convert", path("run"), "--to", "kitti", "--out", path("kitti"), "--force"});
  EXPECT_EQ(ended.status, 3) << ended.err;
  EXPECT_NE(ended.err.find("is not a run folder"), std::string::npos) << ended.err;
}

TEST_F(LogLayouts, LogsThatLackWhatALayoutNeeds) {
  const std::string rig = kRig;
  const std::size_t sensors = rig.find("[sensor.lidar]");
  run_rig(rig.substr(0, sensors));
  expect_refusal({"--to", "euroc"}, 3, "no sensor of IMU samples; it has eyes (points)");
  folder_.write("run/obs.csv", "iteration,landmark_id,x,y,z\n0,-1,2,3,4\n");
  const Ended untrue =
      hallway({"log", "convert", path("run/obs.csv"), "--to", "kitti", "--deskew", "--out", path("none")});
  EXPECT_EQ(untrue.status, 3) << untrue.err;
  EXPECT_NE(untrue.err.find("--deskew needs true poses"), std::string::npos) << untrue.err;
  run_rig(rig +
          "[sensor.lidar2]\nkind = \"lidar\"\nrings = 1\ncolumns = 8\n[sensor.gyro]\nkind = "
          "\"gyro\"\nrate_hz = 50\n");
  expect_refusal({"--to", "kitti"}, 2, "--sensor names one of lidar (range_scan), lidar2 (range_scan)");
  expect_refusal({"--to", "pcd-imu", "--sensor", "lidar"}, 2, "--imu names one of imu (imu), gyro (imu)");
  expect_refusal({"--to", "euroc", "--sensor", "gyro"}, 3, "gyro does not measure all");
}

}  // namespace
}  // namespace hallway::test
