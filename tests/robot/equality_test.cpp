// SPDX-License-Identifier: MIT
// The same frames give the same bytes in every host.
#include <gtest/gtest.h>

#include "base/file.hpp"
#include "cli/batch_results.hpp"
#include "cli/small_world.hpp"
#include "robot/robot_world.hpp"
#include "support/table_readers.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kTables[] = {"trajectory.tum", "landmarks.csv", "submaps.csv", "landmarks.ply",
                                   "commands.csv"};

std::string content(const fs::path& file) {
  return fs::exists(file) ? read_file(file) : "(not there)";
}

void expect_same_tables(const fs::path& a, const fs::path& b) {
  for (const char* table : kTables) EXPECT_EQ(content(a / table), content(b / table)) << table << " in " << b;
}

/// A robot that replays a log of a simulated run, with the run's plugin.
class RecordedRobot : public testing::TestWithParam<const char*> {
 protected:
  RecordedRobot() {
    EXPECT_EQ(world_.run({"--plugin", GetParam(), "--quiet"}).status, 0);
    config_ = world_.folder().write("robot.toml",
                                    "[driver]\nname = \"replay\"\nlog = \"out/run/run.mcap\"\n"
                                    "pace = \"fast\"\n[[plugin]]\nname = \"" +
                                        std::string(GetParam()) + "\"\n");
  }

  fs::path robot(const std::string& name, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"run", config_, "--out", world_.out(name), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = hallway_robot(arguments);
    EXPECT_EQ(ended.status, 0) << ended.err;
    return world_.out(name);
  }

  SmallWorld world_;
  fs::path config_;
};

TEST_P(RecordedRobot, WritesWhatRunAndReplayWrite) {
  const fs::path on_robot = robot("robot");
  expect_same_tables(world_.out(), on_robot);
  ASSERT_EQ(hallway({"replay", on_robot / "run.mcap", "--plugin", GetParam(), "--out", world_.out("again"),
                     "--quiet"})
                .status,
            0);
  expect_same_tables(on_robot, world_.out("again"));
  EXPECT_GT(fs::file_size(on_robot / "trajectory.tum"), 0u);
}

/// "mapped" is the same in every program: landmarks that are still temporary, or that move, are not.
TEST_P(RecordedRobot, CountsTheLandmarksThatAreMapped) {
  const Ended ended = hallway_robot({"run", config_, "--out", world_.out("counted"), "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  int mapped = 0;
  for (const auto& row : read_csv(fs::path(world_.out("counted")) / "landmarks.csv"))
    mapped += row.at(5) == "mapped" ? 1 : 0;
  EXPECT_EQ(Json::parse(ended.out).at("landmarks"), mapped);
}

TEST_P(RecordedRobot, IsTheSameInThisProcess) {
  const fs::path isolated = robot("isolated");
  const fs::path in_process = robot("in_process", {"--in-process"});
  expect_same_tables(isolated, in_process);
  EXPECT_EQ(content(isolated / "run.mcap"), content(in_process / "run.mcap"));
}

INSTANTIATE_TEST_SUITE_P(Plugins, RecordedRobot, testing::Values("slam_point", FIXTURES "/drives.so"),
                         [](const auto& each) { return each.index == 0 ? "SlamPoint" : "Drives"; });

using DrivingRobot = RecordedRobot;

TEST_P(DrivingRobot, CommandsStandInATable) {
  const auto commands = test::parse_commands(read_file(robot("robot") / "commands.csv"), "commands.csv");
  ASSERT_EQ(commands.size(), 60u);
  EXPECT_EQ(commands.back().iteration, 59u);
  EXPECT_GE(commands.front().linear_m_s, 0.25);
}

INSTANTIATE_TEST_SUITE_P(Plugins, DrivingRobot, testing::Values(FIXTURES "/drives.so"),
                         [](const auto&) { return "Drives"; });

using MappingRobot = RecordedRobot;

TEST_P(MappingRobot, WritesNoTableOfCommands) {
  EXPECT_FALSE(fs::exists(robot("robot") / "commands.csv"));
}

TEST_P(MappingRobot, ALoopedLogGoesOnInTimeAndNumber) {
  const fs::path once = robot("once");
  const fs::path twice = robot("twice", {"--set", "driver.loop=true", "--set", "driver.steps=120"});
  const auto frames = nlohmann::ordered_json::parse(read_file(twice / "run.json")).at("robot").at("frames");
  EXPECT_EQ(frames.at("given"), 120);
  EXPECT_EQ(frames.at("lost"), 0);
  // The robot drives the first round again as if the hall went on; the first half is what it was.
  const std::string first = content(once / "trajectory.tum");
  EXPECT_EQ(content(twice / "trajectory.tum").substr(0, first.size()), first);
}

INSTANTIATE_TEST_SUITE_P(Plugins, MappingRobot, testing::Values("slam_point"),
                         [](const auto&) { return "SlamPoint"; });

}  // namespace
}  // namespace hallway::test
