// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <hallway/driver.h>

#include <set>

#include "host/machine/library_facts.hpp"
#include "robot/robot_world.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Driver, ThatDoesNotOpenIsAnErrorAndLeavesNothing) {
  for (const char* where : {"open", "describe"}) {
    const RobotWorld world(std::string("fail = \"") + where + "\"", drives());
    const Ended ended = world.run();
    EXPECT_EQ(ended.status, 3);
    EXPECT_TRUE(holds(ended.err, std::string(where) + "()")) << ended.err;
    EXPECT_TRUE(holds(ended.err, "driver `fake_driver`")) << ended.err;
    EXPECT_FALSE(fs::exists(world.out()));
  }
}

TEST(Driver, ThatFailsInReadStopsTheRobotAndTheLogIsClosed) {
  const RobotWorld world("frames = 50\nread_error = 8\nlock_step = true", drives());
  const Ended ended = world.run();
  EXPECT_EQ(ended.status, 3);
  EXPECT_TRUE(holds(ended.err, "the line is dead")) << ended.err;
  const auto notes = world.notes();
  ASSERT_GE(notes.size(), 2u);
  EXPECT_TRUE(notes[notes.size() - 2].is_answer(HW_ANSWER_END));
  EXPECT_TRUE(notes[notes.size() - 2].stops());
  EXPECT_EQ(world.manifest().at("iterations"), 8);
  EXPECT_EQ(world.manifest().at("robot").at("ended_by"), "failure");
  EXPECT_EQ(hallway({"replay", world.out() + "/run.mcap", "--plugin", FIXTURES "/drives.so", "--out",
                     world.folder() / "again", "--quiet"})
                .status,
            0);
}

TEST(Driver, ThatFailsInWriteEndsTheRun) {
  const RobotWorld world("frames = 50\nwrite_error = 8\nlock_step = true", drives());
  const Ended ended = world.run();
  EXPECT_EQ(ended.status, 3);
  EXPECT_TRUE(holds(ended.err, "the wheels do not listen")) << ended.err;
}

TEST(Driver, ThatLosesFramesIsCounted) {
  const RobotWorld world("frames = 20\ngap = 7\nlock_step = true", drives());
  EXPECT_EQ(world.run().status, 0);
  const auto robot = world.manifest().at("robot");
  EXPECT_EQ(robot.at("frames").at("lost"), 3);
  EXPECT_EQ(robot.at("frames").at("given"), 20);
  EXPECT_EQ(robot.at("driver_counters").at("fake_frames"), 20);
}

TEST(Driver, FramesThatAreNoneAreRefusedInRealTime) {
  const RobotWorld world("frames = 20\nnan = 7\nperiod_ms = 5", drives(), "[robot]\nwatchdog_ms = 20000\n");
  const Ended ended = world.run();
  EXPECT_EQ(ended.status, 0);
  EXPECT_TRUE(holds(ended.err, "frame 7: a point that is not finite")) << ended.err;
  EXPECT_EQ(world.manifest().at("robot").at("frames").at("refused"), 1);
}

TEST(Driver, FramesThatAreNoneEndLockStep) {
  const RobotWorld world("frames = 20\nnan = 7\nlock_step = true", drives());
  const Ended ended = world.run();
  EXPECT_EQ(ended.status, 3);
  EXPECT_TRUE(holds(ended.err, "frame 7: a point that is not finite")) << ended.err;
}

TEST(Driver, IsGivenTheMapWhereItIsAskedFor) {
  const RobotWorld world("frames = 40\nlock_step = true", "name = \"slam_point\"",
                         "[robot]\nreport_every_s = 0.2\n");
  EXPECT_EQ(world.run().status, 0);
  const auto notes = world.notes();
  const auto with_map = [](const Note& n) { return n.landmarks > 0; };
  EXPECT_LT(find_note(notes, 0, with_map), notes.size());
  // 40 frames in 0.8 s of the robot's time, the map asked for every 0.2 s.
  EXPECT_LE(std::count_if(notes.begin(), notes.end(), with_map), 4);
}

TEST(Driver, TheMapIsNotAskedForOtherwise) {
  const RobotWorld world("frames = 40\nlock_step = true", "name = \"slam_point\"");
  EXPECT_EQ(world.run().status, 0);
  for (const Note& note : world.notes()) EXPECT_EQ(note.landmarks, 0u);
}

TEST(Driver, WithoutRecordThereIsNoLog) {
  const RobotWorld world("frames = 10\nlock_step = true", drives(), "[robot]\nrecord = false\n");
  EXPECT_EQ(world.run().status, 0);
  EXPECT_FALSE(fs::exists(world.out() + "/run.mcap"));
  EXPECT_TRUE(fs::exists(world.out() + "/commands.csv"));
}

TEST(Driver, ADurationEndsTheRun) {
  const RobotWorld world("frames = 0", drives());
  EXPECT_EQ(world.run({"--duration", "0.3"}).status, 0);
  EXPECT_EQ(world.manifest().at("robot").at("ended_by"), "duration");
}

TEST(Check, SaysThatAllIsWell) {
  const RobotWorld world("frames = 10", drives());
  const Ended ended = hallway_robot({"check", world.config()});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_TRUE(holds(ended.out, "ready to run"));
  EXPECT_TRUE(holds(ended.out, "watchdog 50 ms")) << ended.out;
  for (const Note& note : world.notes()) EXPECT_EQ(note.what, "closed") << "nothing is read or written";
}

TEST(Check, PrintsTheDriveThatTheConfigurationOverrides) {
  const RobotWorld world("speed = 0.5", drives(), "[drive]\nlatency_s = 0.25\n[body]\nradius_m = 0.125\n");
  const Ended ended = hallway_robot({"check", world.config()});
  EXPECT_EQ(ended.status, 0) << ended.err;
  for (const char* line :
       {"drive      tracked\n", "max_speed_m_s = 0.5\n", "latency_s = 0.25\n", "radius 0.125 m"})
    EXPECT_TRUE(holds(ended.out, line)) << ended.out;
  const Ended other = hallway_robot({"check", world.config(), "--set", "drive.max_speed_m_s=0.375"});
  EXPECT_TRUE(holds(other.out, "max_speed_m_s = 0.375\n")) << other.out;
}

TEST(Check, ADriveWithoutSenseIsTheDriversFault) {
  const RobotWorld world("speed = -1", drives());
  const Ended ended = hallway_robot({"check", world.config()});
  EXPECT_EQ(ended.status, 3);
  EXPECT_TRUE(holds(ended.err, "describe(): gave a drive whose max_speed_m_s is below 0")) << ended.err;
}

TEST(Check, ADriverFromBeforeRobotsHadDrivesIsRead) {
  const RobotWorld world("old = true", drives());
  const Ended ended = hallway_robot({"check", world.config()});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_FALSE(holds(ended.out, "\n  drive ")) << ended.out;
}

TEST(Check, SaysAllThatIsWrong) {
  const RobotWorld world("frmes = 10", drives("slow_sm = 1"), "[[plugin]]\nname = \"no_such_plugin\"\n");
  const Ended ended = hallway_robot({"check", world.config()});
  EXPECT_EQ(ended.status, 3);
  EXPECT_TRUE(holds(ended.err, "robot.toml:4")) << ended.err;
  EXPECT_TRUE(holds(ended.err, "no setting `frmes`")) << ended.err;
  EXPECT_TRUE(holds(ended.err, "did you mean \"frames\"")) << ended.err;
  EXPECT_TRUE(holds(ended.err, "no parameter `slow_sm`")) << ended.err;
  EXPECT_TRUE(holds(ended.err, "robot.toml:7")) << ended.err;
  EXPECT_TRUE(holds(ended.err, "there is no plugin `no_such_plugin`")) << ended.err;
}

TEST(Check, ADriverThatIsNotThereIsNamedWithThoseThatAre) {
  const RobotWorld world("", drives());
  const Ended ended = hallway_robot({"check", world.config(), "--driver", "repay"});
  EXPECT_EQ(ended.status, 4);
  EXPECT_TRUE(holds(ended.err, "there is no driver `repay`")) << ended.err;
  EXPECT_TRUE(holds(ended.err, "did you mean \"replay\"")) << ended.err;
}

TEST(Check, APluginIsNoDriver) {
  const RobotWorld world("", drives());
  const Ended ended = hallway_robot({"check", world.config(), "--driver", FIXTURES "/drives.so"});
  EXPECT_EQ(ended.status, 4);
  EXPECT_TRUE(holds(ended.err, "holds no driver")) << ended.err;
  const Ended other = hallway_robot({"check", world.config(), "--plugin", FAKE_DRIVER});
  EXPECT_EQ(other.status, 4);
  EXPECT_TRUE(holds(other.err, "holds no plugin")) << other.err;
}

TEST(Check, AReplayWantsALog) {
  const RobotWorld world("", drives());
  const Ended none = hallway_robot({"check", world.config(), "--driver", "replay"});
  EXPECT_EQ(none.status, 3);
  EXPECT_TRUE(holds(none.err, "log: is missing")) << none.err;
  const Ended missing =
      hallway_robot({"check", world.config(), "--driver", "replay", "--set", "driver.log=missing.mcap"});
  EXPECT_EQ(missing.status, 3);
  EXPECT_TRUE(holds(missing.err, "missing.mcap")) << missing.err;
  const Ended no_log =
      hallway_robot({"check", world.config(), "--driver", "replay", "--set", "driver.log=robot.toml"});
  EXPECT_EQ(no_log.status, 3);
  EXPECT_TRUE(holds(no_log.err, "robot.toml")) << no_log.err;
}

TEST(Drivers, AreListedWithTheirSettings) {
  const Ended ended = hallway_robot({"drivers", "--json"});
  EXPECT_EQ(ended.status, 0);
  const auto document = nlohmann::ordered_json::parse(ended.out);
  std::set<std::string> keys;
  for (const auto& file : document.at("files")) {
    for (const auto& driver : file.at("drivers")) {
      if (driver.at("id") != "replay") continue;
      for (const auto& setting : driver.at("settings")) keys.insert(setting.at("key").get<std::string>());
    }
  }
  EXPECT_EQ(keys, (std::set<std::string>{"log", "pace", "rate_hz", "loop", "steps"}));
}

TEST(Profile, IsWhatPluginCheckReads) {
  const TempFolder folder;
  const Ended profile = hallway_robot({"profile"});
  ASSERT_EQ(profile.status, 0);
  const fs::path file = folder.write("robot.toml", profile.out);
  const Ended checked =
      hallway({"plugin", "check", binary_folder() / "lib/hallway/plugins/slam_point.so", "--profile", file});
  EXPECT_EQ(checked.status, 0) << checked.out << checked.err;
}

/// Nothing of maps, rays or pictures, whatever the version.
TEST(Program, NeedsFewLibraries) {
  const std::set<std::string> allowed{
      "libfmt",          "libzstd",         "libz", "libstdc++", "libm", "libgcc_s", "libc",
      "ld-linux-x86-64", "ld-linux-aarch64"};
  const auto facts = host::read_library_facts(robot_program());
  EXPECT_FALSE(facts.needed.empty());
  for (const std::string& library : facts.needed) {
    const bool sanitizer =
        library.starts_with("libasan") || library.starts_with("libubsan") || library.starts_with("libtsan");
    EXPECT_TRUE(sanitizer || allowed.contains(library.substr(0, library.find(".so")))) << library;
  }
}

}  // namespace
}  // namespace hallway::test
