// SPDX-License-Identifier: MIT
// Whatever a plugin does wrong while it drives a robot, the driver is told to stop in the frame in which it does, or by the watchdog before it, and never to
// move again; the verdict says who failed, how and where.
#include <gtest/gtest.h>
#include <hallway/driver.h>

#include <vector>

#include "robot/robot_world.hpp"

namespace hallway::test {
namespace {

constexpr int kAt = 8, kFrames = 20;

struct DrivingFault {
  const char* how;      ///< of the fixture fails_driving
  const char* verdict;  ///< empty: it has not failed
};

class FaultyDrivers : public testing::TestWithParam<DrivingFault> {
 protected:
  static bool fails() { return *GetParam().verdict != '\0'; }
  static bool hangs() { return GetParam().verdict == std::string("timeout"); }

  static RobotWorld world(bool lock_step, const std::string& policy) {
    const std::string driver = "frames = " + std::to_string(kFrames) +
                               "\nperiod_ms = 50\nlock_step = " + (lock_step ? "true" : "false");
    const std::string plugin = "name = \"" FIXTURES "/fails_driving.so\"\nparams = {how = \"" +
                               std::string(GetParam().how) + "\", at = " + std::to_string(kAt) + "}";
    return {driver, plugin,
            "[robot]\ncommand_timeout_s = 0.1\n" + std::string(lock_step ? "" : "watchdog_ms = 400\n") +
                "[limits]\ncall_timeout_s = " + (hangs() ? "2" : "60") +
                "\nmemory_limit_mib = 512\non_failure = \"" + policy + "\"\n"};
  }

  static void expect_verdict(const nlohmann::ordered_json& manifest) {
    if (!fails()) {
      EXPECT_TRUE(manifest.at("verdict").is_null());
      return;
    }
    EXPECT_EQ(manifest.at("verdict").at("what"), GetParam().verdict);
    EXPECT_EQ(manifest.at("verdict").at("iteration"), kAt);
    EXPECT_EQ(manifest.at("verdict").at("plugin"), "fails_driving");
  }

  /// What was written to the driver, without times.
  static std::vector<std::string> answers(const std::vector<Note>& notes) {
    std::vector<std::string> told;
    for (const Note& note : notes) {
      if (note.what == "answer")
        told.push_back(std::to_string(note.sequence) + " " + std::to_string(note.status) + " " +
                       std::to_string(note.linear) + " " + note.message);
    }
    return told;
  }

  /// The robot moves before the fault, is told to stop, and never to move again.
  static void expect_stopped(const std::vector<Note>& notes) {
    const auto moves = [](const Note& note) { return note.what == "answer" && note.linear > 0.0; };
    const auto stops = [](const Note& note) { return note.what == "answer" && note.stops(); };
    EXPECT_LT(find_note(notes, 0, moves), notes.size());
    const std::size_t stopped =
        find_note(notes, 0, [&](const Note& note) { return note.sequence >= kAt && stops(note); });
    ASSERT_LT(stopped, notes.size());
    EXPECT_LE(notes[stopped].sequence, fails() ? std::uint64_t{kAt} : std::uint64_t{kAt + 2})
        << "in the frame of the fault, or when the command has timed out";
    EXPECT_EQ(find_note(notes, stopped, moves), notes.size());
  }
};

TEST_P(FaultyDrivers, AreStopped) {
  for (const char* policy : {"stop", "continue"}) {
    SCOPED_TRACE(policy);
    std::vector<std::string> first;
    for (int time = 0; time < 2; ++time) {
      const RobotWorld robot = world(true, policy);
      const Ended ended = robot.run();
      EXPECT_EQ(ended.status, fails() ? 5 : 0) << ended.err;
      expect_stopped(robot.notes());
      expect_verdict(robot.manifest());
      if (fails()) {
        EXPECT_NE(ended.out.find("plugin failures              1, 0 restarts"), std::string::npos)
            << ended.out;
      }
      const std::vector<std::string> told = answers(robot.notes());
      if (time == 0) first = told;
      EXPECT_EQ(told, first) << "twice the same";
    }
  }
}

TEST_P(FaultyDrivers, AreStoppedInRealTime) {
  const RobotWorld robot = world(false, "continue");
  EXPECT_EQ(robot.run().status, fails() ? 5 : 0);
  const auto notes = robot.notes();
  const auto moves = [](const Note& note) { return note.what == "answer" && note.linear > 0.0; };
  const auto last = find_note(notes, 0, [](const Note& note) { return note.is_answer(HW_ANSWER_END); });
  ASSERT_LT(last, notes.size());
  EXPECT_TRUE(notes[last].stops());
  EXPECT_LT(find_note(notes, 0, moves), notes.size());
  const std::size_t failed = find_note(notes, 0, [](const Note& note) { return note.sequence > kAt; });
  EXPECT_EQ(find_note(notes, failed, moves), notes.size()) << "after the frame of the fault";
}

TEST_P(FaultyDrivers, DriveOnWithANewInstance) {
  const RobotWorld robot = world(true, "restart");
  robot.run();
  const auto notes = robot.notes();
  const std::size_t failed =
      find_note(notes, 0, [](const Note& note) { return note.is_answer(HW_ANSWER_FAILED); });
  EXPECT_EQ(failed < notes.size(), fails());
  EXPECT_EQ(robot.manifest().at("restarts"), fails() ? 1 : 0);
  const bool again = find_note(notes, failed, [](const Note& note) {
                       return note.is_answer(HW_ANSWER_DONE) && note.linear > 0.0;
                     }) < notes.size();
  EXPECT_EQ(again, fails());
}

INSTANTIATE_TEST_SUITE_P(Faults, FaultyDrivers,
                         testing::Values(DrivingFault{"crash", "crash"}, DrivingFault{"hang", "timeout"},
                                         DrivingFault{"nan_command", "fault"}, DrivingFault{"silence", ""},
                                         DrivingFault{"exit", "exit"}, DrivingFault{"memory", "memory"},
                                         DrivingFault{"throws", "fault"}),
                         [](const auto& fault) { return "of_" + std::string(fault.param.how); });

/// What a robot does with a command beyond its limits is up to its driver.
TEST(WildCommands, ReachTheDriverAsTheyAre) {
  const RobotWorld world("frames = 20\nlock_step = true",
                         "name = \"" FIXTURES "/fails_driving.so\"\nparams = {how = \"1e300_m_s\", at = 8}");
  EXPECT_EQ(world.run().status, 0);
  const auto notes = world.notes();
  const std::size_t wild = find_note(
      notes, 0, [](const Note& note) { return note.is_answer(HW_ANSWER_DONE) && note.sequence == 8; });
  ASSERT_LT(wild, notes.size());
  EXPECT_EQ(notes[wild].linear, 1e300);
}

}  // namespace
}  // namespace hallway::test
