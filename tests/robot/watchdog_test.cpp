// SPDX-License-Identifier: MIT
// A robot is stopped when its plugin is late or dead, when no frame comes, and at the end. What is asserted is what was written to the
// driver and in what order; how long it took is printed.
#include <gtest/gtest.h>
#include <hallway/driver.h>
#include <signal.h>

#include <iostream>

#include "robot/robot_world.hpp"

namespace hallway::test {
namespace {

const std::string kWatchdog = "[robot]\nwatchdog_ms = 100\n";

bool late(const Note& note) {
  return note.is_answer(HW_ANSWER_LATE);
}
bool failed(const Note& note) {
  return note.is_answer(HW_ANSWER_FAILED);
}
bool moving(const Note& note) {
  return note.is_answer(HW_ANSWER_DONE) && note.linear > 0.0;
}

/// Every answer but one in time stops the robot; the last one is END, and after it the driver is closed.
void expect_safe(const std::vector<Note>& notes) {
  for (const Note& note : notes) {
    if (note.what == "answer" && note.status != HW_ANSWER_DONE) {
      EXPECT_TRUE(note.stops()) << note.message;
      EXPECT_FALSE(note.message.empty());
    }
  }
  ASSERT_FALSE(notes.empty());
  EXPECT_EQ(notes.back().what, "closed");
  const auto is_answer = [](const Note& note) { return note.what == "answer"; };
  const auto last = std::find_if(notes.rbegin(), notes.rend(), is_answer);
  ASSERT_NE(last, notes.rend());
  EXPECT_TRUE(last->is_answer(HW_ANSWER_END));
}

/// Prints how long after the frame before it a note came.
void print_time(const char* what, const std::vector<Note>& notes, std::size_t at) {
  std::size_t frame = at;
  while (frame > 0 && notes[frame].what != "frame") --frame;
  std::cout << what << ": " << static_cast<double>(notes[at].t_ns - notes[frame].t_ns) * 1e-6
            << " ms after its frame was read\n";
}

TEST(Watchdog, ASlowPluginStopsTheRobotUntilItIsInTimeAgain) {
  const RobotWorld world("frames = 60", drives("slow_from = 10, slow_frames = 1, slow_ms = 600"), kWatchdog);
  const Ended ended = world.run();
  EXPECT_EQ(ended.status, 0) << ended.err;
  const auto notes = world.notes();
  expect_safe(notes);
  const std::size_t stopped =
      find_note(notes, 0, [](const Note& n) { return late(n) && n.message.starts_with("no answer"); });
  ASSERT_LT(stopped, notes.size());
  print_time("slow plugin", notes, stopped);
  // The answer comes after all: it is handed on, and moves nothing.
  const std::size_t answer = find_note(notes, stopped + 1, late);
  ASSERT_LT(answer, notes.size());
  EXPECT_EQ(notes[answer].sequence, notes[stopped].sequence);
  EXPECT_LT(find_note(notes, answer, moving), notes.size());
  const auto timing = world.manifest().at("robot").at("timing");
  EXPECT_GE(timing.at("watchdog_trips"), 1);
  EXPECT_GE(timing.at("late_answers"), 1);
  EXPECT_NE(ended.err.find("watchdog"), std::string::npos);
}

TEST(Watchdog, AHangingPluginStopsTheRobotBeforeItIsKilled) {
  const RobotWorld world("frames = 0", breaks("deadlock", 5), kWatchdog + "[limits]\ncall_timeout_s = 3\n");
  EXPECT_EQ(world.run().status, 5);
  const auto notes = world.notes();
  expect_safe(notes);
  const std::size_t stopped =
      find_note(notes, 0, [](const Note& n) { return late(n) && n.message.starts_with("no answer"); });
  ASSERT_LT(stopped, notes.size());
  print_time("hanging plugin", notes, stopped);
  const std::size_t dead = find_note(notes, stopped, failed);
  ASSERT_LT(dead, notes.size());
  EXPECT_EQ(notes[dead].sequence, notes[stopped].sequence);
  EXPECT_EQ(world.manifest().at("verdict").at("what"), "timeout");
  EXPECT_EQ(world.manifest().at("robot").at("ended_by"), "plugin");
}

TEST(Watchdog, ACrashingPluginStopsTheRobotAtOnceAndIsStartedAgain) {
  const RobotWorld world("frames = 60", breaks("segv", 5),
                         kWatchdog + "[limits]\non_failure = \"restart\"\n");
  EXPECT_EQ(world.run().status, 5);
  const auto notes = world.notes();
  expect_safe(notes);
  const std::size_t dead = find_note(notes, 0, failed);
  ASSERT_LT(dead, notes.size());
  print_time("crashing plugin", notes, dead);
  EXPECT_LT(find_note(notes, dead, [](const Note& n) { return n.is_answer(HW_ANSWER_DONE); }), notes.size());
  EXPECT_EQ(world.manifest().at("restarts"), 1);
  EXPECT_EQ(world.manifest().at("verdict").at("what"), "crash");
}

TEST(CommandTimeout, StopsARobotWhosePluginFallsSilent) {
  const std::string silent = drives("silent_from = 5");
  for (const bool limited : {true, false}) {
    const RobotWorld world("frames = 12\nlock_step = true\nperiod_ms = 100", silent,
                           limited ? "[robot]\ncommand_timeout_s = 0.25" : "");
    ASSERT_EQ(world.run().status, 0);
    std::vector<std::uint64_t> stopped;
    for (const Note& note : world.notes())
      if (note.is_answer(HW_ANSWER_DONE) && note.stops()) stopped.push_back(note.sequence);
    EXPECT_EQ(stopped, limited ? std::vector<std::uint64_t>{7} : std::vector<std::uint64_t>{})
        << "frame 4 had the last command";
    const auto timing = world.manifest().at("robot").at("timing");
    EXPECT_EQ(timing.value("command_timeouts", -1), limited ? 1 : -1);
  }
}

TEST(Watchdog, ACrashedPluginThatIsNotStartedAgainStopsTheRobotInEveryFrame) {
  const RobotWorld world("frames = 12\nlock_step = true", breaks("segv", 5),
                         "[limits]\non_failure = \"continue\"\n");
  EXPECT_EQ(world.run().status, 5);
  const auto notes = world.notes();
  expect_safe(notes);
  EXPECT_EQ(std::count_if(notes.begin(), notes.end(), failed), 7);
}

TEST(Watchdog, NoFramesStopTheRobotUntilTheyComeAgain) {
  const RobotWorld world("frames = 60\nstall = 20\nstall_ms = 600", drives(), kWatchdog);
  EXPECT_EQ(world.run().status, 0);
  const auto notes = world.notes();
  expect_safe(notes);
  const std::size_t stopped =
      find_note(notes, 0, [](const Note& n) { return late(n) && n.message.starts_with("no frame"); });
  ASSERT_LT(stopped, notes.size());
  print_time("no frames", notes, stopped);
  EXPECT_LT(find_note(notes, stopped, moving), notes.size());
}

TEST(Watchdog, LockStepWaitsAsLongAsItTakes) {
  const RobotWorld world("frames = 10\nlock_step = true",
                         drives("slow_from = 5, slow_frames = 1, slow_ms = 300"), kWatchdog);
  const Ended ended = world.run();
  EXPECT_EQ(ended.status, 0);
  EXPECT_NE(ended.err.find("watchdog_ms is not used"), std::string::npos);
  const auto notes = world.notes();
  EXPECT_EQ(std::count_if(notes.begin(), notes.end(), moving), 10);
}

TEST(Interrupt, StopsTheRobotFirstAndClosesTheLogProperly) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const RobotWorld world("frames = 0", drives(), kWatchdog);
    std::vector<std::string> arguments = world.arguments();
    arguments.insert(arguments.begin(), robot_program());
    Process process(arguments);
    ASSERT_TRUE(world.wait_for_note([](const Note& n) { return moving(n) && n.sequence >= 5; }));
    ::kill(process.pid(), signal);
    EXPECT_EQ(process.wait().status, 128 + signal);
    expect_safe(world.notes());
    EXPECT_EQ(world.manifest().at("stopped_early"), true);
    EXPECT_EQ(hallway({"replay", world.out() + "/run.mcap", "--plugin", FIXTURES "/drives.so", "--out",
                       world.folder() / "again", "--quiet"})
                  .status,
              0);
    EXPECT_EQ(read_file(world.out() + "/commands.csv"), read_file(world.folder() / "again/commands.csv"));
  }
}

TEST(Interrupt, StopsTheRobotWhileThePluginHangs) {
  // In lock-step, where the watchdog does not look at the clock: only the signal can stop it.
  const RobotWorld world("frames = 0\nlock_step = true", breaks("deadlock", 3),
                         "[limits]\ncall_timeout_s = 5\n");
  std::vector<std::string> arguments = world.arguments();
  arguments.insert(arguments.begin(), robot_program());
  Process process(arguments);
  ASSERT_TRUE(world.wait_for_note([](const Note& n) { return n.what == "frame" && n.sequence == 3; }));
  ::kill(process.pid(), SIGINT);
  EXPECT_TRUE(world.wait_for_note([](const Note& n) { return n.is_answer(HW_ANSWER_END) && n.stops(); }));
  EXPECT_EQ(process.wait().status, 5) << "the plugin was killed for its time, after the robot stood still";
  const auto notes = world.notes();
  EXPECT_EQ(find_note(notes, 0, failed), notes.size()) << "nothing is handed on after END";
}

TEST(Pacing, ASlowPluginMissesDeadlinesAndFramesAreDropped) {
  const RobotWorld world("frames = 60\nperiod_ms = 10",
                         drives("slow_from = 0, slow_frames = 1000, slow_ms = 35"),
                         "[robot]\nrate_hz = 100\nwatchdog_ms = 20000\n");
  EXPECT_EQ(world.run().status, 0);
  const auto robot = world.manifest().at("robot");
  const auto& frames = robot.at("frames");
  EXPECT_EQ(robot.at("timing").at("deadline_ms"), 10.0);
  EXPECT_EQ(robot.at("timing").at("deadline_misses"), frames.at("answered"));
  EXPECT_GT(frames.at("dropped"), 0);
  EXPECT_EQ(frames.at("read"), 60);
  EXPECT_EQ(frames.at("given").get<int>() + frames.at("dropped").get<int>(), 60);
  EXPECT_GE(robot.at("timing").at("latency_ms").at("median"), 30.0);
}

/// Frames of a robot whose plugin takes 100 ms for one of them, ten times as long as the next one needs to come.
nlohmann::ordered_json frames_with_one_slow(const std::string& backlog) {
  const RobotWorld world("frames = 60\nperiod_ms = 10",
                         drives("slow_from = 20, slow_frames = 1, slow_ms = 100"),
                         "[robot]\nwatchdog_ms = 20000\n" + backlog);
  EXPECT_EQ(world.run().status, 0);
  return world.manifest().at("robot").at("frames");
}

TEST(Backlog, FramesThatCameMeanwhileAreAnsweredToo) {
  const auto frames = frames_with_one_slow("backlog = 60\n");
  EXPECT_EQ(frames.at("given"), 60);
  EXPECT_EQ(frames.at("dropped"), 0);
}

TEST(Backlog, OfMoreThanMayWaitTheOldestAreDropped) {
  const auto frames = frames_with_one_slow("backlog = 2\n");
  EXPECT_GE(frames.at("dropped"), 1);
  EXPECT_EQ(frames.at("given").get<int>() + frames.at("dropped").get<int>(), 60);
}

}  // namespace
}  // namespace hallway::test
