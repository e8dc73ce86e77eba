// SPDX-License-Identifier: MIT
// What a scenario makes happen to a robot.
#include "sim/event.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/error.hpp"
#include "support/errors.hpp"
#include "unit/sim/drive_world.hpp"

namespace hallway::sim {
namespace {

using test::driven_text;
using test::DriveWorld;
using test::forward;
using test::start_at;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::string event(const std::string& keys) {
  return "[[event]]\n" + keys;
}

DriveWorld with_event(const std::string& keys, const std::string& robot = "") {
  return DriveWorld(driven_text(robot, "kind = 'differential'\n", event(keys)),
                    start_at("0 0 50") + start_at("300 200 50", "far"));
}

/// Drives ahead for some frames.
void drive_on(DriveWorld& world, int frames, double speed_m_s = 0.5) {
  for (int i = 0; i < frames; ++i) {
    world.robot->obey(forward(speed_m_s));
    world.robot->advance();
  }
}

TEST(Event, AKidnappedRobotIsElsewhereAtThatTimeAndNeverBetween) {
  DriveWorld world = with_event("at_s = 2.025\nkind = 'kidnap'\nplace_m = [-3, 1, 0.4]\nyaw_deg = 90\n");
  drive_on(world, 20);
  EXPECT_NEAR(world.pose().t.x(), 0.875, 1e-9);
  drive_on(world, 1);
  const Pose before = world.robot->pose_at(2'024'999'999), after = world.robot->pose_at(2'025'000'000);
  EXPECT_NEAR(before.t.x(), 0.875 + 0.0125, 1e-6);
  EXPECT_EQ(after.t, Vec3(-3, 1, 0)) << "it is put down on the floor";
  EXPECT_NEAR((after.q * Vec3::UnitX()).y(), 1.0, 1e-12);
  drive_on(world, 20);
  // At rest when it is put down: 1 m/s2 up to 0.5 m/s.
  EXPECT_NEAR(world.pose().t.y(), 1.0 + 0.125 + 0.5 * (2.075 - 0.5), 1e-9);
  EXPECT_NEAR(world.robot->wheel_travel_at(4'100'000'000)[0], 0.8875 + 0.9125, 1e-9)
      << "wheels do not turn on the way";
  EXPECT_NEAR(world.robot->counts().distance_m, 0.8875 + 0.9125, 1e-9) << "to be carried is not to drive";
  EXPECT_EQ(world.robot->counts().contacts, 0u);
}

TEST(Event, AKidnapToANamedStartAtAFramesTimeIsInThatFrame) {
  DriveWorld world = with_event("at_s = 1\nkind = 'kidnap'\nto = 'far'\n");
  drive_on(world, 10);
  EXPECT_EQ(world.robot->frame(), 10u);
  EXPECT_EQ(world.simulator->step(10, *world.robot).T_world_body.t, Vec3(3, 2, 0));
  EXPECT_NEAR(world.robot->pose_at(kSecond_ns - 1).t.y(), 0.0, 1e-12);
}

TEST(Event, AKidnapFromAWallEndsTheContact) {
  DriveWorld world = with_event("at_s = 13\nkind = 'kidnap'\nplace_m = [0, 0, 0.4]\nyaw_deg = 180\n");
  drive_on(world, 130);
  EXPECT_EQ(world.robot->counts().contacts, 1u);
  EXPECT_GT(world.robot->counts().stood_s, 1.0);
  const double stood_s = world.robot->counts().stood_s;
  drive_on(world, 20);
  EXPECT_EQ(world.robot->counts().stood_s, stood_s);
  EXPECT_LT(world.pose().t.x(), -0.8);
  drive_on(world, 100);
  EXPECT_EQ(world.robot->counts().contacts, 2u) << "the wall behind";
}

TEST(Event, APushMovesTheBodyAndNotTheWheels) {
  DriveWorld world = with_event("at_s = 0.52\nkind = 'push'\nlateral_m_s = 0.4\nduration_s = 0.75\n");
  drive_on(world, 6, 0.0);
  EXPECT_NEAR(world.robot->pose_at(520'000'000).t.y(), 0.0, 1e-12);
  EXPECT_NEAR(world.pose().t.y(), 0.4 * 0.08, 1e-9);
  drive_on(world, 7, 0.0);
  EXPECT_NEAR(world.robot->pose_at(1'270'000'000).t.y(), 0.3, 1e-9);
  drive_on(world, 7, 0.0);
  EXPECT_NEAR(world.pose().t.y(), 0.3, 1e-9);
  EXPECT_EQ(world.robot->wheel_travel_at(2 * kSecond_ns)[0], 0.0);
}

TEST(Event, APushAgainstAWallIsAContactAndDoesNotBounceBack) {
  DriveWorld world = with_event("at_s = 0\nkind = 'push'\nlinear_m_s = 2\nduration_s = 3\n");
  drive_on(world, 30, 0.0);
  const double at_wall = world.pose().t.x();
  EXPECT_NEAR(at_wall, 4.8, 1e-3);
  EXPECT_EQ(world.robot->counts().contacts, 1u);
  drive_on(world, 20, 0.0);
  EXPECT_NEAR(world.pose().t.x(), at_wall, 1e-3);
}

TEST(Event, BlockedWheelsStandAndThenGoOnAsCommanded) {
  DriveWorld world = with_event("at_s = 1.03\nkind = 'wheels_blocked'\nduration_s = 1.5\n");
  drive_on(world, 40);
  const double until_block = 0.125 + 0.5 * 0.53;
  EXPECT_NEAR(world.robot->pose_at(3'900'000'000).t.x(), until_block + 0.125 + 0.5 * (3.9 - 2.53 - 0.5),
              1e-9);
  DriveWorld again = with_event("at_s = 1.03\nkind = 'wheels_blocked'\nduration_s = 1.5\n");
  drive_on(again, 25);
  EXPECT_NEAR(again.pose().t.x(), until_block, 1e-9);
  EXPECT_NEAR(again.robot->wheel_travel_at(2'500'000'000)[1], until_block, 1e-9);
  EXPECT_EQ(again.robot->counts().stood_s, 0.0) << "nothing is in its way";
}

TEST(Event, ASensorGivesNoReadingsWhileItIsOff) {
  DriveWorld world(driven_text("", "kind = 'differential'\n",
                               event("at_s = 3\nkind = 'sensor_on'\nsensor = 'wheels'\n") +
                                   event("at_s = 1\nkind = 'sensor_off'\nsensor = 'wheels'\n")));
  for (std::uint32_t frame = 0; frame < 50; ++frame) {
    const Frame seen = world.simulator->step(frame, *world.robot);
    const bool is_off = frame >= 10 && frame < 30;
    EXPECT_EQ(seen.readings.size(), is_off ? 1u : 2u) << frame;
    for (const Reading& reading : seen.readings) {
      EXPECT_EQ(reading.sequence, frame) << "what is not read shows as a gap";
      if (reading.sensor == 1 && frame == 30) {
        EXPECT_GT(std::get<EncoderSensed>(reading.sensed).reading.ticks[0], 1000);
      }
    }
    drive_on(world, 1);
  }
}

TEST(Event, WhatHappensDoesNotDependOnOtherEvents) {
  DriveWorld plain(driven_text());
  DriveWorld later = with_event("at_s = 3.3\nkind = 'push'\nlateral_m_s = 0.4\nduration_s = 0.75\n");
  for (int i = 0; i < 33; ++i) {
    drive_on(plain, 1);
    drive_on(later, 1);
    EXPECT_EQ(plain.pose().t, later.pose().t);
  }
}

TEST(Event, WhatCannotHappenIsRefusedWithItsLine) {
  struct Case {
    std::string keys, message;
  };
  const std::vector<Case> cases{
      {"kind = 'push'\nlinear_m_s = 1\nduration_s = 1\n", "at_s`: is missing"},
      {"at_s = -1\nkind = 'push'\n", "at_s"},
      {"at_s = nan\nkind = 'push'\n", "at_s"},
      {"at_s = 1\nkind = 'shove'\n", "shove"},
      {"at_s = 1\nkind = 'push'\nduration_s = 1\n", "a push moves the robot"},
      {"at_s = 1\nkind = 'push'\nlinear_m_s = 1e300\nduration_s = 1\n", "linear_m_s"},
      {"at_s = 1\nkind = 'push'\nlinear_m_s = 1\n", "duration_s"},
      {"at_s = 1\nkind = 'push'\nlinear_m_s = 1\nduration_s = 1\nsensor = 'eyes'\n", "sensor"},
      {"at_s = 1\nkind = 'kidnap'\n", "give it or `place_m`"},
      {"at_s = 1\nkind = 'kidnap'\nto = 'far'\nplace_m = [0, 0, 0]\n", "give one of them"},
      {"at_s = 1\nkind = 'kidnap'\nto = 'nowhere'\n", "no robot start `nowhere`"},
      {"at_s = 1\nkind = 'kidnap'\nplace_m = [4.9, 0, 0.4]\n", "overlaps something where it is carried to"},
      {"at_s = 1\nkind = 'kidnap'\nplace_m = [50, 0, 0.4]\n", "no floor"},
      {"at_s = 1\nkind = 'wheels_blocked'\nduration_s = 0\n", "duration_s"},
      {"at_s = 1\nkind = 'sensor_off'\nsensor = 'eyes'\n", "no sensor `eyes`"},
      {"at_s = 1\nkind = 'sensor_off'\n", "sensor"},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.keys);
    const auto error = hallway::test::error_of([&] { with_event(one.keys); });
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
    EXPECT_NE(std::string(error->what()).find(one.message), std::string::npos) << error->what();
    EXPECT_GT(error->where().line, 14) << error->what();
  }
}

TEST(Event, ARobotOnAPathHasSensorsThatGoOffAndNoDrive) {
  const std::string on_path = "map = \"small.map\"\nsteps = 40\n[robot]\n[sensor.eyes]\nkind = 'points'\n";
  hallway::test::TempFolder folder;
  folder.write("small.map", hallway::test::map_text(test::room(), start_at("0 0 50")));
  const auto load = [&](const std::string& keys) {
    return load_scenario(folder.write("s.toml", on_path + event(keys)));
  };
  const Simulator simulator(load("at_s = 1\nkind = 'sensor_off'\nsensor = 'eyes'\n"), 1,
                            trace::Backend::kBruteForce);
  EXPECT_EQ(simulator.step(9).readings.size(), 1u);
  EXPECT_EQ(simulator.step(10).readings.size(), 0u);
  EXPECT_EQ(simulator.step(9).readings.size(), 1u) << "in any order";
  const auto error =
      hallway::test::error_of([&] { load("at_s = 1\nkind = 'push'\nlinear_m_s = 1\nduration_s = 1\n"); });
  ASSERT_TRUE(error);
  EXPECT_NE(std::string(error->what()).find("[robot.drive]"), std::string::npos);
}

}  // namespace
}  // namespace hallway::sim
