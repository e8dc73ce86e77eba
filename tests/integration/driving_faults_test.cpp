// SPDX-License-Identifier: MIT
// A robot whose plugin fails while it drives stands within the watchdog's time, one frame, and what its drive takes to slow down: in a run, and where it is
// served to a robot program. Who failed, how and where is said, and it is the same in every run.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "log/drive_tables.hpp"
#include "log/tum.hpp"
#include "support/process.hpp"
#include "support/room_maps.hpp"
#include "support/served.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using log::CommandCause;

constexpr int kAt = 20;  // the frame at which plugins fail
constexpr int kSteps = 50;
constexpr double kPeriod_s = 0.1, kWatchdog_s = 0.2, kLatency_s = 0.03;
constexpr double kSpeed_m_s = 0.4, kDeceleration_m_s2 = 1.0;

struct Fault {
  const char* how;      ///< of the fixture fails_driving
  const char* verdict;  ///< empty: it has not failed
};

constexpr Fault kCrash{"crash", "crash"}, kHang{"hang", "timeout"}, kNan{"nan_command", "fault"},
    kSilence{"silence", ""}, kExit{"exit", "exit"}, kMemory{"memory", "memory"}, kThrows{"throws", "fault"};

std::string fails_driving() {
  return FIXTURES "/fails_driving.so";
}

/// A room of 5 m by 2 m, along which the robot looks.
std::string room_map() {
  return "{\n\"classname\" \"worldspawn\"\n\"_scale\" \"0.01\"\n" +
         box_brush({-20, -20, -20}, {520, 220, 270}, "concrete") + "}\n{\n\"classname\" \"hw_subtract\"\n" +
         box_brush({0, 0, 0}, {500, 200, 250}, "plaster") + "}\n" +
         point_entity("hw_robot_start", {50, 100, 20});
}

std::string scenario() {
  return "map = \"room.map\"\nseed = 3\nsteps = " + std::to_string(kSteps) + R"(
period_s = 0.1
memory_limit_mib = 512
[robot]
radius_m = 0.2
bottom_m = 0.03
top_m = 0.5
watchdog_s = 0.2
[robot.drive]
kind = "differential"
latency_s = 0.03
forward_noise = { sigma = 0.05, correlation_s = 1.0 }
left_slip = { mean = 0.02, sigma = 0.02, correlation_s = 0.5 }
[sensor.eyes]
kind = "points"
max_range_m = 12
noise_m = 0.01
[[plugin]]
name = ")" +
         fails_driving() + "\"\n";
}

struct FaultyRuns : testing::TestWithParam<Fault> {
  FaultyRuns() {
    folder_.write("room.map", room_map());
    file_ = folder_.write("drive.toml", scenario());
  }

  fs::path out(const std::string& name) const { return folder_ / name; }
  static bool fails() { return *GetParam().verdict != '\0'; }
  /// Short where it is to be over.
  static double call_timeout_s() { return GetParam().verdict == std::string("timeout") ? 2.0 : 60.0; }
  static int status() { return fails() ? 5 : 0; }

  Ended run(const std::string& name, const std::string& policy, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{
        "run",      file_,
        "--plugin", fails_driving() + ":how=" + GetParam().how + ",at=" + std::to_string(kAt),
        "--set",    "on_failure=" + policy,
        "--set",    "call_timeout_s=" + std::to_string(call_timeout_s()),
        "--out",    out(name)};
    if (!fails()) more.insert(more.end(), {"--set", "robot.command_timeout_s=0.2"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    Ended ended = hallway(arguments);
    EXPECT_EQ(ended.status, status()) << ended.err;
    return ended;
  }

  /// A robot program's configuration.
  std::string config(const std::string& name, const std::string& address, bool lock_step,
                     const std::string& policy, double call_timeout_s) const {
    return folder_.write(
        name + ".toml", "[driver]\nname = \"udp\"\naddress = \"" + address +
                            "\"\nlockstep = " + (lock_step ? "true" : "false") + "\n[[plugin]]\nname = \"" +
                            fails_driving() + "\"\nparams = { how = \"" + GetParam().how +
                            "\", at = " + std::to_string(kAt) + " }\n[limits]\non_failure = \"" + policy +
                            "\"\nmemory_limit_mib = 512\ncall_timeout_s = " + std::to_string(call_timeout_s) +
                            "\n" + (fails() ? "" : "[robot]\ncommand_timeout_s = 0.2\n"));
  }

  /// The simulator at one end of a network, a robot program at the other.
  Ended rehearse(const std::string& name, bool lock_step, const std::string& policy) const {
    std::vector<std::string> arguments{file_, "--out", out(name)};
    if (lock_step) arguments.emplace_back("--lockstep");
    Served served(arguments);
    EXPECT_NE(served.address(), "");
    const Ended robot =
        hallway_robot({"run", config(name, served.address(), lock_step, policy, call_timeout_s()), "--quiet",
                       "--out", out(name + "_robot")});
    EXPECT_EQ(robot.status, status()) << robot.err;
    return served.wait();
  }

  TempFolder folder_;
  std::string file_;
};

Json read_json(const fs::path& file) {
  return Json::parse(read_file(file));
}

/// The first frame from which on the true pose is the same; the last one where it moves until the end.
std::size_t first_standing(const fs::path& folder) {
  const auto poses = log::read_tum(folder / "truth.tum");
  std::size_t first = poses.size() - 1;
  while (first > 0 && poses[first - 1].position_m == poses.back().position_m &&
         poses[first - 1].orientation == poses.back().orientation)
    --first;
  return first;
}

/// The last frame at which a robot may still have moved, if its plugin failed at a frame.
constexpr double kTimeToStand_s = kWatchdog_s + kPeriod_s + kLatency_s + kSpeed_m_s / kDeceleration_m_s2;
const std::size_t kLatestMotion = kAt + static_cast<std::size_t>(std::ceil(kTimeToStand_s / kPeriod_s));

/// A robot that comes to rest in the last period goes less far in it than one that slows down throughout, 5 mm.
void expect_rests_at_the_end(const fs::path& folder) {
  const auto poses = log::read_tum(folder / "truth.tum");
  const auto &last = poses.at(poses.size() - 1).position_m, &before = poses.at(poses.size() - 2).position_m;
  EXPECT_LT(std::hypot(last[0] - before[0], last[1] - before[1]),
            0.9 * 0.5 * kDeceleration_m_s2 * kPeriod_s * kPeriod_s);
}

void expect_stands(const fs::path& folder) {
  EXPECT_GT(first_standing(folder), std::size_t{kAt}) << "it drove when the plugin failed";
  EXPECT_LE(first_standing(folder), kLatestMotion);
  expect_rests_at_the_end(folder);
  const auto poses = log::read_tum(folder / "truth.tum");
  EXPECT_GT(poses[kAt].position_m[0] - poses[0].position_m[0], 0.6);
  const std::string contacts = read_file(folder / "contacts.csv");
  EXPECT_EQ(contacts.find('\n') + 1, contacts.size()) << "it stands of its own accord";
}

void expect_same(const fs::path& a, const fs::path& b, const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    ASSERT_TRUE(fs::exists(a / file)) << file;
    EXPECT_TRUE(read_file(a / file) == read_file(b / file)) << file << " of " << b;
  }
}

const std::vector<std::string> kFiles{"truth.tum", "truth_poses.csv", "drive.csv", "contacts.csv",
                                      "commands.csv"};

std::vector<CommandCause> causes_of(const fs::path& folder) {
  std::vector<CommandCause> causes;
  for (const log::ObeyedCommand& command : log::read_obeyed_commands(folder / "drive.csv"))
    causes.push_back(command.cause);
  return causes;
}

void expect_verdict(const fs::path& folder, const Fault& fault) {
  const Json manifest = read_json(folder / "run.json");
  if (*fault.verdict == '\0') {
    EXPECT_TRUE(manifest.at("verdict").is_null());
    return;
  }
  EXPECT_EQ(manifest.at("verdict").at("what"), fault.verdict);
  EXPECT_EQ(manifest.at("verdict").at("iteration"), kAt);
  EXPECT_EQ(manifest.at("verdict").at("call"), "process");
  EXPECT_EQ(manifest.at("failures"), 1);
}

TEST_P(FaultyRuns, TheRobotStands) {
  for (const char* policy : {"stop", "continue"}) {
    SCOPED_TRACE(policy);
    const Ended ended = run(policy, policy);
    expect_stands(out(policy));
    expect_verdict(out(policy), GetParam());
    EXPECT_EQ(read_json(out(policy) / "metrics.json").at("drive").at("stops"), 1);
    EXPECT_NE(ended.out.find("1 stop by watchdog or time-out"), std::string::npos) << ended.out;
    if (fails()) {
      EXPECT_NE(ended.err.find("iteration 20: "), std::string::npos) << ended.err;
      EXPECT_NE(ended.out.find("plugin failures              1, 0 restarts"), std::string::npos) << ended.out;
    }
    const std::vector<CommandCause> causes = causes_of(out(policy));
    EXPECT_EQ(causes.size() == std::size_t{kSteps}, !fails() || policy == std::string("continue"))
        << "a run that stops goes on until the robot stands";
    EXPECT_EQ(causes.at(kAt - 1), CommandCause::kPlugin);
    EXPECT_EQ(causes.at(kAt), fails() ? CommandCause::kWatchdog : CommandCause::kHeld);
    EXPECT_EQ(causes.at(kAt + 2), fails() ? CommandCause::kFailure : CommandCause::kTimeout);
  }
  const std::string stopped = read_file(out("stop") / "truth.tum");
  EXPECT_TRUE(read_file(out("continue") / "truth.tum").starts_with(stopped)) << "the same motion";
  run("again", "stop");
  expect_same(out("stop"), out("again"), kFiles);
  EXPECT_TRUE(read_file(out("stop") / "run.mcap") == read_file(out("again") / "run.mcap")) << "the whole log";
}

struct RestartedRuns : FaultyRuns {};
struct RunsInOneProcess : FaultyRuns {};

/// A new instance answers the next frame, within the watchdog's time: the robot never slows down.
TEST_P(RestartedRuns, DriveOn) {
  for (const char* name : {"a", "b"}) run(name, "restart");
  expect_same(out("a"), out("b"), kFiles);
  expect_verdict(out("a"), GetParam());
  EXPECT_EQ(read_json(out("a") / "run.json").at("restarts"), 1);
  EXPECT_EQ(read_json(out("a") / "metrics.json").at("drive").at("stops"), 0);
  std::vector<CommandCause> expected(kSteps, CommandCause::kPlugin);
  expected.at(kAt) = CommandCause::kWatchdog;
  EXPECT_EQ(causes_of(out("a")), expected);
  EXPECT_EQ(first_standing(out("a")), std::size_t{kSteps - 1}) << "it moves until the end";
}

TEST_P(RunsInOneProcess, HaveTheSameBytes) {
  for (const char* policy : {"stop", "continue"}) {
    run(std::string("isolated_") + policy, policy);
    run(std::string("in_process_") + policy, policy, {"--in-process"});
    expect_same(out(std::string("isolated_") + policy), out(std::string("in_process_") + policy), kFiles);
    expect_verdict(out(std::string("in_process_") + policy), GetParam());
  }
}

TEST_P(FaultyRuns, ServedInLockStepTheRobotStands) {
  for (const std::string policy : {"stop", "continue"}) {
    SCOPED_TRACE(policy);
    for (const char* name : {"a", "b"}) {
      const Ended ended = rehearse(policy + name, true, policy);
      EXPECT_EQ(ended.status, 0) << ended.err;
      EXPECT_NE(ended.out.find("by watchdog or time-out"), std::string::npos) << ended.out;
      expect_verdict(out(policy + name + "_robot"), GetParam());
    }
    expect_same(out(policy + "a"), out(policy + "b"), kFiles);
    expect_same(out(policy + "a_robot"), out(policy + "b_robot"), {"commands.csv"});
    EXPECT_TRUE(read_file(out(policy + "a") / "run.mcap") == read_file(out(policy + "b") / "run.mcap"));
    expect_stands(out(policy + "a"));
    const Json manifest = read_json(out(policy + "a") / "run.json");
    const bool leaves = fails() && policy == "stop";
    EXPECT_EQ(manifest.at("host").at("serving").at("end"), leaves ? "left" : "all_sent");
    EXPECT_EQ(manifest.at("iterations").get<int>() < kSteps, leaves);
    EXPECT_EQ(log::read_tum(out(policy + "a") / "truth.tum").size(), manifest.at("iterations"));
  }
}

TEST_P(FaultyRuns, ServedInRealTimeTheRobotStands) {
  const Ended ended = rehearse("real", false, "stop");
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_GT(first_standing(out("real")), 5u) << "it drove";
  expect_rests_at_the_end(out("real"));
  const Json verdict = read_json(out("real_robot") / "run.json").at("verdict");
  if (fails()) {
    EXPECT_EQ(verdict.at("what"), GetParam().verdict);
  } else {
    EXPECT_TRUE(verdict.is_null());
  }
}

std::string name_of(const testing::TestParamInfo<Fault>& fault) {
  return "of_" + std::string(fault.param.how);
}
INSTANTIATE_TEST_SUITE_P(Faults, FaultyRuns,
                         testing::Values(kCrash, kHang, kNan, kSilence, kExit, kMemory, kThrows), name_of);
INSTANTIATE_TEST_SUITE_P(Faults, RestartedRuns, testing::Values(kCrash, kHang, kNan, kExit, kMemory, kThrows),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Faults, RunsInOneProcess, testing::Values(kNan, kSilence, kThrows),
                         name_of);  // the program outlives them

/// What a robot program killed in the middle of a frame leaves behind: nobody tells the robot to stop.
class KilledRobots : public FaultyRuns {
 protected:
  /// Until the robot program's log grows no more: its plugin hangs.
  void wait_for_the_hanging_frame(const fs::path& log_folder) const {
    std::uintmax_t size = 0;
    for (int quiet = 0, i = 0; quiet < 10 && i < 1200; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      std::uintmax_t now = 0;
      for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
        if (entry.path().filename() == "run.mcap" &&
            entry.path().string().find(log_folder.filename().string()) != std::string::npos)
          now = entry.file_size();
      }
      quiet = now > 0 && now == size ? quiet + 1 : 0;
      size = now;
    }
  }
};

TEST_P(KilledRobots, AreGivenUpAndStand) {
  for (const bool lock_step : {true, false}) {
    const std::string name = lock_step ? "lock_step" : "real_time";
    SCOPED_TRACE(name);
    std::vector<std::string> arguments{file_,     "--out", out(name + "_served"), "--give-up", "2",
                                       "--steps", "100000"};
    if (lock_step) arguments.emplace_back("--lockstep");
    Served served(arguments);
    ASSERT_NE(served.address(), "");
    Process robot({robot_program(), "run", config(name, served.address(), lock_step, "stop", 1e5), "--quiet",
                   "--out", out(name + "_robot")});
    wait_for_the_hanging_frame(out(name + "_robot"));
    ::kill(robot.pid(), SIGKILL);
    EXPECT_EQ(robot.wait().status, 128 + SIGKILL);
    const Ended ended = served.wait();
    EXPECT_EQ(ended.status, 1) << "it fell silent: " << ended.err;
    const fs::path folder = out(name + "_served");
    EXPECT_EQ(read_json(folder / "run.json").at("host").at("serving").at("end"), "silent");
    EXPECT_GT(first_standing(folder), 5u) << "it drove";
    expect_rests_at_the_end(folder);
    if (lock_step) expect_stands(folder);
  }
}

INSTANTIATE_TEST_SUITE_P(Faults, KilledRobots, testing::Values(kHang), name_of);

/// Commands that a drive cannot obey are no faults: it does what it can, and counts.
struct WildRuns : FaultyRuns {};

TEST_P(WildRuns, AreClampedCountedAndDriven) {
  run("run", "stop");
  run("in_process", "stop", {"--in-process"});
  EXPECT_EQ(rehearse("served", true, "stop").status, 0);
  for (const char* name : {"in_process", "served"}) expect_same(out("run"), out(name), kFiles);
  const bool too_fast = GetParam().how == std::string("1e300_m_s");
  for (const char* name : {"run", "served"}) {
    const Json drive = read_json(out(name) / "metrics.json").at("drive");
    EXPECT_EQ(drive.at("commands"), kSteps);
    EXPECT_EQ(drive.at("commands_clamped"), too_fast ? 1 : 0);
    EXPECT_EQ(drive.at("commands_left_out"), too_fast ? 0 : 1);
    EXPECT_EQ(drive.at("stops"), 0);
  }
  const log::ObeyedCommand obeyed = log::read_obeyed_commands(out("run") / "drive.csv").at(kAt);
  EXPECT_EQ(obeyed.linear_m_s, too_fast ? 0.6 : kSpeed_m_s);
  EXPECT_EQ(obeyed.lateral_m_s, 0.0);
  EXPECT_EQ(obeyed.changes, too_fast ? "speed" : "left_out");
  EXPECT_EQ(obeyed.cause, CommandCause::kPlugin);
  EXPECT_NE(read_file(out("run") / "commands.csv").find(too_fast ? "20,1e+300,0" : "20,0.4,0,0.2"),
            std::string::npos)
      << "as it was given: " << read_file(out("run") / "commands.csv");
  EXPECT_EQ(first_standing(out("run")), std::size_t{kSteps - 1}) << "it moves until the end";
}

INSTANTIATE_TEST_SUITE_P(Faults, WildRuns, testing::Values(Fault{"1e300_m_s", ""}, Fault{"sideways", ""}),
                         name_of);

}  // namespace
}  // namespace hallway::test
