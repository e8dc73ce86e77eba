// SPDX-License-Identifier: MIT
// A robot that a plugin drives, as a user of the program sees it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/small_world.hpp"
#include "log/drive_tables.hpp"
#include "support/data.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using log::CommandCause;

std::string office_drive() {
  return source_folder() / "maps/office_drive.toml";
}

/// Its commands are functions of the points that it sees.
std::string drives() {
  return (binary_folder() / "tests/abi/fixtures/drives.so").string();
}

Ended drive_office(const std::string& plugin, const fs::path& out,
                   const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"run",   office_drive(), "--plugin", plugin,  "--steps", "60",
                                     "--out", out.string(),   "--quiet",  "--set", "seed=3"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return hallway(arguments);
}

/// Status 0; if not, with what the program wrote on its standard error.
testing::AssertionResult succeeds(const Ended& ended) {
  if (ended.status == 0) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "status " << ended.status << ": " << ended.err;
}

std::vector<CommandCause> causes_of(const fs::path& folder) {
  std::vector<CommandCause> causes;
  for (const log::ObeyedCommand& command : log::read_obeyed_commands(folder / "drive.csv"))
    causes.push_back(command.cause);
  return causes;
}

nlohmann::json drive_of(const fs::path& folder) {
  return nlohmann::json::parse(read_file(folder / "metrics.json")).at("drive");
}

TEST(DriveRuns, APluginMovesTheRobot) {
  const TempFolder folder;
  ASSERT_TRUE(succeeds(drive_office("wanderer", folder / "a")));
  const std::string fast = "wanderer:speed_m_s=0.25";
  ASSERT_TRUE(succeeds(drive_office(fast, folder / "b")));
  EXPECT_NE(read_file(folder / "a/truth.tum"), read_file(folder / "b/truth.tum"));
  EXPECT_GT(drive_of(folder / "a").at("distance_m").get<double>(),
            drive_of(folder / "b").at("distance_m").get<double>());
  EXPECT_EQ(causes_of(folder / "a"), std::vector<CommandCause>(60, CommandCause::kPlugin));
}

/// A plugin that is too slow is ended for it; a frame is 0.1 s, the watchdog's time 0.2 s.
TEST(DriveRuns, ARobotWhosePluginHangsStandsAfterTheWatchdogsTime) {
  const TempFolder folder;
  const std::string hangs = drives() + ":slow_from=20,slow_frames=1,slow_ms=60000";
  for (const char* policy : {"stop", "continue"}) {
    for (const char* name : {"a", "b"}) {
      const Ended ended =
          drive_office(hangs, folder / (std::string(policy) + name),
                       {"--set", "call_timeout_s=2", "--set", std::string("on_failure=") + policy});
      EXPECT_EQ(ended.status, 5) << ended.err;
    }
    const fs::path a = folder / (std::string(policy) + "a"), b = folder / (std::string(policy) + "b");
    for (const char* table : {"drive.csv", "truth.tum", "contacts.csv", "commands.csv"})
      EXPECT_EQ(read_file(a / table), read_file(b / table)) << policy << ": " << table;
    const std::vector<CommandCause> causes = causes_of(a);
    ASSERT_GT(causes.size(), 23u) << policy << ": the run goes on until the robot stands";
    EXPECT_EQ(causes[19], CommandCause::kPlugin);
    EXPECT_EQ(causes[20], CommandCause::kWatchdog);
    EXPECT_EQ(causes[21], CommandCause::kWatchdog);
    EXPECT_EQ(causes[22], CommandCause::kFailure);
    EXPECT_EQ(causes.back(), CommandCause::kFailure);
    EXPECT_EQ(causes.size() == 60, policy == std::string("continue")) << policy;
    EXPECT_EQ(drive_of(a).at("stops"), 1) << policy;
    const std::string truth = read_file(a / "truth.tum");  // its last two lines differ in their times alone
    const std::size_t last = truth.rfind('\n', truth.size() - 2), before = truth.rfind('\n', last - 1);
    const auto pose = [](const std::string& line) { return line.substr(line.find(' ')); };
    if (policy == std::string("continue")) {
      EXPECT_EQ(pose(truth.substr(last + 1)), pose(truth.substr(before + 1, last - before)));
    }
  }
}

TEST(DriveRuns, ASilentPluginsLastCommandHolds) {
  const TempFolder folder;
  const std::string falls_silent = drives() + ":silent_from=10";
  ASSERT_TRUE(succeeds(drive_office(falls_silent, folder / "held")));
  EXPECT_EQ(causes_of(folder / "held").back(), CommandCause::kHeld);
  ASSERT_TRUE(succeeds(drive_office(falls_silent, folder / "timed", {"--set", "robot.command_timeout_s=1"})));
  const std::vector<CommandCause> causes = causes_of(folder / "timed");
  EXPECT_EQ(causes[18], CommandCause::kHeld);
  EXPECT_EQ(causes[19], CommandCause::kTimeout) << "a second after the last command, at frame 9";
}

/// The frames of a replay are those of the log, whatever is commanded.
TEST(DriveRuns, AReplaySaysWhereItsCommandsDiffer) {
  const TempFolder folder;
  ASSERT_TRUE(succeeds(drive_office("wanderer", folder / "run")));
  const auto replayed = [&](const std::string& plugin, const std::string& name) {
    const Ended ended =
        hallway({"replay", folder / "run/run.mcap", "--plugin", plugin, "--out", folder / name});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(read_file(folder / name / "truth.tum"), read_file(folder / "run/truth.tum"));
    EXPECT_NE(ended.out.find("commands, open loop"), std::string::npos) << ended.out;
    return nlohmann::json::parse(read_file(folder / name / "run.json")).at("replayed_commands");
  };
  const nlohmann::json same = replayed("wanderer", "same");
  EXPECT_EQ(same.at("compared"), 60);
  EXPECT_EQ(same.at("different"), 0);
  EXPECT_TRUE(same.at("first_different").is_null());
  const nlohmann::json faster = replayed("wanderer:speed_m_s=0.6", "faster");
  EXPECT_EQ(faster.at("compared"), 60);
  EXPECT_EQ(faster.at("first_different"), 0);
  EXPECT_GT(faster.at("different"), 0);
}

TEST(DriveRuns, EventsStandInTheTableTheLogAndTheReplay) {
  const TempFolder folder;
  const std::string scenario = source_folder() / "maps/office_events.toml";
  for (const char* name : {"a", "b"}) {
    std::vector<std::string> arguments{"run", scenario, "--steps", "600", "--out", folder / name, "--quiet"};
    if (name[0] == 'b') arguments.insert(arguments.end(), {"--in-process", "--threads", "4"});
    const Ended ended = hallway(arguments);
    ASSERT_EQ(ended.status, 0) << ended.err;
  }
  const std::vector<log::EventRow> events = log::read_events(folder / "a/events.csv");
  ASSERT_EQ(events.size(), 5u);
  EXPECT_EQ(events[0], (log::EventRow{10'000'000'000, "push", "0 m/s 0.8 m/s 1 rad/s for 0.5 s"}));
  EXPECT_EQ(events[2], (log::EventRow{30'000'000'000, "sensor_off", "eyes"}));
  EXPECT_EQ(events[4], (log::EventRow{50'000'000'000, "kidnap", "to 18 7.6 0.5"}));
  for (const char* table : {"events.csv", "truth.tum", "drive.csv", "contacts.csv"})
    EXPECT_EQ(read_file(folder / "a" / table), read_file(folder / "b" / table)) << table;
  const Ended replayed =
      hallway({"replay", folder / "a/run.mcap", "--plugin", "wanderer", "--out", folder / "again"});
  ASSERT_EQ(replayed.status, 0) << replayed.err;
  EXPECT_EQ(read_file(folder / "again/events.csv"), read_file(folder / "a/events.csv"));
}

/// What a plugin drove once is driven again without it, from the run's log or table.
TEST(DriveRuns, CommandsOfARunMoveTheRobotAsTheyDid) {
  const TempFolder folder;
  ASSERT_TRUE(succeeds(drive_office("wanderer", folder / "a")));
  for (const char* file : {"run.mcap", "drive.csv"}) {
    const fs::path out = folder / (std::string("again_") + file);
    const Ended again = drive_office(
        "wanderer", out,
        {"--set", "robot.driven_by=commands", "--set", "robot.commands=" + (folder / "a" / file).string()});
    ASSERT_EQ(again.status, 0) << again.err;
    for (const char* same : {"truth.tum", "contacts.csv"})
      EXPECT_EQ(read_file(out / same), read_file(folder / "a" / same)) << file << ": " << same;
    EXPECT_EQ(causes_of(out).front(), CommandCause::kCommands);
  }
  folder.write("short.mcap", read_file(folder / "a/run.mcap").substr(0, 4000));
  const Ended cut = drive_office(
      "wanderer", folder / "cut",
      {"--set", "robot.driven_by=commands", "--set", "robot.commands=" + (folder / "short.mcap").string()});
  EXPECT_EQ(cut.status, 3);
  EXPECT_NE(cut.err.find("short.mcap"), std::string::npos) << cut.err;
}

TEST(DriveRuns, ARobotFileIsNoMap) {
  const Ended ended = hallway({"run", source_folder() / "maps/robots/first.map"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_NE(ended.err.find("robot file"), std::string::npos) << ended.err;
}

TEST(DriveRuns, WhoDrivesIsClear) {
  const TempFolder folder;
  const auto told = [&](const std::string& plugin, const std::vector<std::string>& more,
                        const std::string& part) {
    const Ended ended = drive_office(plugin, folder / "none", more);
    EXPECT_EQ(ended.status, 3) << ended.err;
    EXPECT_NE(ended.err.find(part), std::string::npos) << ended.err;
    EXPECT_FALSE(fs::exists(folder / "none"));
  };
  told("slam_point", {}, "none of the scenario's gives drive commands");
  told("slam_point", {"--set", "robot.driving_plugin=slam_point"}, "gives no drive commands");
  told("wanderer", {"--set", "robot.driving_plugin=wonderer"}, "is no plugin of the scenario");
  told("wanderer", {"--set", "robot.commands=no.csv"}, "no.csv");
  told("wanderer", {"--set", "robot.start=nowhere"}, "nowhere");
}

// ---- Robot files ----------------------------------------------------------------------------------------------------

const std::string kRobotBegin =
    "{\n\"classname\" \"worldspawn\"\n\"_scale\" \"0.01\"\n\"_hallway_robot\" \"1\"\n}\n";
const std::string kRobotFileBody =
    "{\n\"classname\" \"hw_body\"\n\"radius_m\" \"0.2\"\n\"bottom_m\" \"0.03\"\n\"top_m\" \"0.5\"\n}\n";
const std::string kRobotDrive =
    "{\n\"classname\" \"hw_drive\"\n\"wheel_base_m\" \"0.32\"\n\"max_speed_m_s\" \"0.5\"\n\"latency_s\" "
    "\"0.03\"\n"
    "\"left_slip_mean\" \"0.02\"\n\"left_slip_sigma\" \"0.02\"\n\"step_m\" \"0.02\"\n}\n";
const std::string kRobotSensors =
    "{\n\"classname\" \"hw_sensor\"\n\"name\" \"bumper\"\n\"kind\" \"bump\"\n\"zones\" \"8\"\n\"depth\" "
    "\"1\"\n}\n"
    "{\n\"classname\" \"hw_sensor\"\n\"name\" \"wheels\"\n\"kind\" \"encoders\"\n\"rate_hz\" \"25\"\n}\n"
    "{\n\"classname\" \"hw_sensor\"\n\"name\" \"eyes\"\n\"origin\" \"10 0 40\"\n\"max_range_m\" \"9\"\n"
    "\"noise_m\" \"0.01\"\n\"pitch_deg\" \"3\"\n}\n";
const std::string kSameRobot =
    "radius_m = 0.2\nbottom_m = 0.03\ntop_m = 0.5\nstep_m = 0.02\n"
    "[robot.drive]\nkind = 'differential'\nwheel_base_m = 0.32\nmax_speed_m_s = 0.5\nlatency_s = 0.03\n"
    "left_slip = { mean = 0.02, sigma = 0.02 }\n"
    "[sensor.bumper]\nkind = 'bump'\nzones = 8\ndepth = true\n"
    "[sensor.wheels]\nkind = 'encoders'\nrate_hz = 25\n"
    "[sensor.eyes]\nkind = 'points'\nposition_m = [0.1, 0, 0.4]\nmax_range_m = 9\nnoise_m = 0.01\npitch_deg "
    "= 3\n";

/// A robot in the office that its plugin drives.
std::string scenario_of(const std::string& robot) {
  return "map = \"" + (source_folder() / "maps/office.map").string() +
         "\"\nseed = 3\nsteps = 300\n[robot]\nstart = 'free'\n" + robot + "[[plugin]]\nname = 'wanderer'\n";
}

Ended run_in(const TempFolder& folder, const std::string& scenario, const std::string& out) {
  return hallway({"run", scenario, "--quiet", "--force", "--out", folder / out});
}

TEST(DriveRuns, ARobotFileIsTheSameKeysWrittenOut) {
  const TempFolder folder, other;
  folder.write("robot.map", kRobotBegin + kRobotFileBody + kRobotDrive + kRobotSensors);
  const Ended named = run_in(folder, folder.write("s.toml", scenario_of("file = 'robot.map'\n")), "a");
  ASSERT_EQ(named.status, 0) << named.err;
  const Ended written = run_in(folder, other.write("s.toml", scenario_of(kSameRobot)), "b");
  ASSERT_EQ(written.status, 0) << written.err;
  std::size_t bytes = 0;
  for (const char* file : {"truth.tum", "truth_poses.csv", "drive.csv", "contacts.csv", "commands.csv",
                           "observations_eyes.csv"}) {
    const std::string text = read_file(folder / "a" / file);
    EXPECT_EQ(text, read_file(folder / "b" / file)) << file;
    bytes += text.size();
  }
  EXPECT_GT(bytes, 10'000u);
  EXPECT_EQ(drive_of(folder / "a"), drive_of(folder / "b"));
  const auto frames = [&](const char* run) {
    std::string all;
    for (const char* frame : {"0", "150", "299"})
      all += hallway({"log", "frame", folder / run / "run.mcap", frame}).out;
    return all;
  };
  EXPECT_EQ(frames("a"), frames("b"));
  EXPECT_NE(frames("a").find("bump"), std::string::npos);
}

TEST(DriveRuns, TheFolderOfARunWithARobotFileStandsForItself) {
  const TempFolder folder;
  const std::string robot =
      folder.write("robot.map", kRobotBegin + kRobotFileBody + kRobotDrive + kRobotSensors);
  const std::string scenario = folder.write("s.toml", scenario_of("file = 'robot.map'\n"));
  ASSERT_TRUE(succeeds(run_in(folder, scenario, "a")));
  EXPECT_EQ(read_file(folder / "a/robot.map"), read_file(robot));
  const auto manifest = nlohmann::json::parse(read_file(folder / "a/run.json"));
  EXPECT_EQ(manifest.at("inputs").at(2).at("file"), "robot.map");
  const fs::path name = folder / "picture.png", copy = folder / "a/scenario.toml";
  fs::remove(robot);
  EXPECT_EQ(run_in(folder, scenario, "b").status, 3) << "the robot file is gone";
  EXPECT_TRUE(succeeds(run_in(folder, copy, "b")));
  for (const char* file : {"truth.tum", "drive.csv"})
    EXPECT_EQ(read_file(folder / "a" / file), read_file(folder / "b" / file)) << file;
  EXPECT_EQ(
      hallway({"render", folder / "a", "--iteration", "100", "--out", name, "--size", "200x100"}).status, 0);
  EXPECT_EQ(hallway({"replay", folder / "a/run.mcap", "--quiet", "--out", folder / "c"}).status, 0);
}

}  // namespace
}  // namespace hallway::test
