// SPDX-License-Identifier: MIT
// A robot with a drive in a room of 10 m by 10 m, whose floor is at z = 0.
#include "sim/driven_robot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "base/error.hpp"
#include "sim/simulator.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/sim/drive_world.hpp"
#include "unit/sim/small_world.hpp"

namespace hallway::sim {
namespace {

using test::driven_text;
using test::DriveWorld;
using test::forward;
using test::room;
using test::start_at;

constexpr double kWall_m = 5.0;
constexpr double kRadius_m = 0.2;

TEST(SimulatedDrive, ACommandOfATableMovesAsItsClosedFormSays) {
  DriveWorld world(driven_text("commands = 'commands.csv'\n"));
  EXPECT_EQ(world.robot->obey({}).cause, CommandCause::kCommands);
  for (int i = 0; i < 20; ++i) {
    world.robot->advance();
    EXPECT_EQ(world.robot->obey({}).cause, CommandCause::kHeld);
  }
  // 1 m/s2 up to 0.5 m/s, then 1.5 s of that.
  EXPECT_NEAR(world.pose().t.x(), 0.125 + 0.75, 1e-9);
  EXPECT_NEAR(world.pose().t.z(), 0.0, 1e-12) << "the body's origin, 3 cm below its bottom, is on the floor";
  for (const double way : world.robot->wheel_travel_at(1'900'000'000)) EXPECT_NEAR(way, 0.875 - 0.05, 1e-9);
  for (const double way : world.robot->wheel_travel_at(2'000'000'000)) EXPECT_NEAR(way, 0.875, 1e-9);
}

TEST(SimulatedDrive, WhatIsBeyondLimitsIsClampedCountedAndDriven) {
  DriveWorld world(driven_text());
  const CommandInForce huge = world.robot->obey(forward(1e300));
  EXPECT_EQ(huge.obeyed.command.forward_m_s, 0.6);
  EXPECT_TRUE(huge.obeyed.clamps.speed);
  world.robot->advance();
  EXPECT_TRUE(world.robot->obey(forward(0.5, 0.5)).obeyed.clamps.left_out) << "wheels do not go sideways";
  for (int i = 0; i < 10; ++i) world.robot->advance();
  const DriveCounts counts = world.robot->counts();
  EXPECT_EQ(counts.commands, 2u);
  EXPECT_EQ(counts.clamped, 1u);
  EXPECT_EQ(counts.left_out, 1u);
  EXPECT_GT(world.pose().t.x(), 0.3);
  EXPECT_EQ(world.pose().t.y(), 0.0);
}

TEST(SimulatedDrive, AWallStopsItAndPressesTheZonesInFront) {
  DriveWorld world(driven_text());
  bool pressed = false;
  for (std::uint32_t frame = 0; frame < 150; ++frame) {
    const Frame seen = world.simulator->step(frame, *world.robot);
    for (const Reading& reading : seen.readings) {
      if (reading.sensor != 0) continue;
      ASSERT_EQ(std::get<BumpSensed>(reading.sensed).reading.zones.size(), 4u);
      pressed = std::get<BumpSensed>(reading.sensed).reading.zones[0].pressed ||
                std::get<BumpSensed>(reading.sensed).reading.zones[3].pressed;
      if (pressed) {
        EXPECT_GT(seen.T_world_body.t.x(), kWall_m - kRadius_m - 0.08);
      }
      EXPECT_FALSE(std::get<BumpSensed>(reading.sensed).reading.zones[1].pressed ||
                   std::get<BumpSensed>(reading.sensed).reading.zones[2].pressed)
          << "there is nothing behind it";
    }
    EXPECT_LT(seen.T_world_body.t.x() + kRadius_m, kWall_m);
    world.robot->obey(forward(0.5));
    world.robot->advance();
  }
  EXPECT_TRUE(pressed) << "it is still pressed against the wall";
  const DriveCounts counts = world.robot->counts();
  EXPECT_EQ(counts.contacts, 1u);
  EXPECT_NEAR(counts.distance_m, kWall_m - kRadius_m, 0.01);
  EXPECT_GT(counts.stood_s, 3.0);
  EXPECT_EQ(counts.rooms_entered, 1u);
  EXPECT_GT(counts.cells_visited, 8u);
  EXPECT_GT(counts.floor_cells, 300u);
}

TEST(SimulatedDrive, EncodersCountTheWaysOfTheWheels) {
  DriveWorld world(driven_text());
  const double tick_m = 2.0 * 3.14159265358979323846 * 0.05 / 1024.0;
  for (std::uint32_t frame = 0; frame < 40; ++frame) {
    const Frame seen = world.simulator->step(frame, *world.robot);
    const std::vector<double> ways = world.robot->wheel_travel_at(seen.t_ns);
    for (const Reading& reading : seen.readings) {
      if (reading.sensor != 1) continue;
      ASSERT_EQ(std::get<EncoderSensed>(reading.sensed).reading.ticks.size(), 2u);
      for (std::size_t wheel = 0; wheel < 2; ++wheel)
        EXPECT_NEAR(
            static_cast<double>(std::get<EncoderSensed>(reading.sensed).reading.ticks[wheel]) * tick_m,
            ways[wheel], tick_m);
    }
    world.robot->obey({.command = drive::Command{.forward_m_s = 0.3, .angular_rad_s = 0.5}});
    world.robot->advance();
  }
  const std::vector<double> ways = world.robot->wheel_travel_at(4'000'000'000);
  EXPECT_GT(ways[1], ways[0] + 0.3) << "the right wheel is the outer one of a turn to the left";
}

/// The causes of the frames in which a command was in force, and where the robot stands.
std::vector<CommandCause> causes_after(DriveWorld& world, int frames, const DriveAnswer& answer) {
  std::vector<CommandCause> causes;
  for (int i = 0; i < frames; ++i) {
    causes.push_back(world.robot->obey(answer).cause);
    world.robot->advance();
  }
  return causes;
}

TEST(SimulatedDrive, AfterAFailureTheLastCommandHoldsForTheWatchdogsTime) {
  DriveWorld world(driven_text("watchdog_s = 0.25\n"));
  causes_after(world, 10, forward(0.5));
  EXPECT_TRUE(world.robot->is_moving());
  const std::vector<CommandCause> causes = causes_after(world, 20, {.failed = true});
  EXPECT_EQ(causes[0], CommandCause::kWatchdog);
  EXPECT_EQ(causes[2], CommandCause::kWatchdog) << "it runs out between this frame and the next one";
  EXPECT_EQ(causes[3], CommandCause::kFailure);
  EXPECT_FALSE(world.robot->is_moving());
  // 1 s with a ramp up of 0.5 s, the watchdog's 0.25 s, and the ramp down.
  EXPECT_NEAR(world.pose().t.x(), 0.125 + 0.25 + 0.125 + 0.125, 1e-9);
  EXPECT_EQ(world.robot->counts().stops, 1u);
  EXPECT_EQ(causes_after(world, 1, forward(0.5)).front(), CommandCause::kPlugin)
      << "a plugin that is there again drives";
  EXPECT_TRUE(world.robot->is_moving());
}

TEST(SimulatedDrive, WithoutNewCommandsTheLastOneHoldsAsLongAsTheScenarioSays) {
  DriveWorld held(driven_text());
  causes_after(held, 1, forward(0.5));
  EXPECT_EQ(causes_after(held, 30, {}).back(), CommandCause::kHeld);
  DriveWorld timed(driven_text("command_timeout_s = 0.5\n"));
  causes_after(timed, 1, forward(0.5));
  const std::vector<CommandCause> causes = causes_after(timed, 30, {});
  EXPECT_EQ(causes[3], CommandCause::kHeld);
  EXPECT_EQ(causes[4], CommandCause::kTimeout) << "half a second after the command";
  EXPECT_FALSE(timed.robot->is_moving());
  EXPECT_NEAR(timed.pose().t.x(), 0.125 + 0.125, 1e-9);
}

TEST(SimulatedDrive, WithoutACommandItStands) {
  DriveWorld world(driven_text());
  EXPECT_EQ(causes_after(world, 5, {}).back(), CommandCause::kNone);
  EXPECT_EQ(causes_after(world, 5, {.failed = true}).back(), CommandCause::kNone);
  EXPECT_EQ(world.pose().t, Vec3::Zero());
  EXPECT_FALSE(world.robot->is_moving());
}

TEST(SimulatedDrive, FollowsItsPath) {
  DriveWorld world(driven_text("path = 'round'\nspeed_m_s = 0.4\nlook_ahead_m = 0.3\n"));
  double farthest = 0.0;
  for (int i = 0; i < 380; ++i) {
    EXPECT_EQ(world.robot->obey({}).cause, CommandCause::kPath);
    world.robot->advance();
    const Vec3 at = world.pose().t;  // from a square of 2 m
    farthest = std::max(farthest, std::abs(std::max(std::abs(at.x()), std::abs(at.y())) - 1.0));
  }
  EXPECT_LT(farthest, 0.15);
  EXPECT_GT(world.robot->counts().distance_m, 10.0) << "more than a round";
  EXPECT_EQ(world.robot->counts().contacts, 0u);
}

TEST(SimulatedDrive, BeginsWhereItIsTold) {
  const std::string starts = start_at("100 0 50") + start_at("-200 100 50", "west");
  EXPECT_EQ(DriveWorld(driven_text(), starts).pose().t, Vec3(1.0, 0.0, 0.0)) << "at the one without a name";
  EXPECT_EQ(DriveWorld(driven_text("start = 'west'\n"), starts).pose().t, Vec3(-2.0, 1.0, 0.0));
  const DriveWorld a(driven_text("start = 'free'\n"), ""), b(driven_text("start = 'free'\n"), "");
  EXPECT_EQ(a.pose().t, b.pose().t);
  std::string other = driven_text("start = 'free'\n");
  const DriveWorld c(other.replace(other.find("seed = 5"), 8, "seed = 6"), "");
  EXPECT_NE(a.pose().t, c.pose().t) << "another seed";
  for (const DriveWorld* world : {&a, &c}) {
    EXPECT_LT(world->pose().t.head<2>().cwiseAbs().maxCoeff(), kWall_m - kRadius_m);
    EXPECT_EQ(world->pose().t.z(), 0.0);
  }
}

struct BadDrive {
  const char* name;
  std::string scenario;
  std::string entities;
  const char* part;
};

class BadDrives : public testing::TestWithParam<BadDrive> {};

TEST_P(BadDrives, AreRefusedWithTheirCause) {
  const auto error =
      test::error_of([&] { const DriveWorld world(GetParam().scenario, GetParam().entities); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_NE(std::string(error->what()).find(GetParam().part), std::string::npos) << error->what();
}

const std::string kHere = start_at("0 0 50");
const std::string kDifferential = "kind = 'differential'\n";

INSTANTIATE_TEST_SUITE_P(
    SimulatedDrive, BadDrives,
    testing::Values(
        BadDrive{"NoKind", driven_text("", ""), kHere, "kind"},
        BadDrive{"UnknownKind", driven_text("", "kind = 'hover'\n"), kHere, "hover"},
        BadDrive{"UnknownKey", driven_text("", kDifferential + "max_sped_m_s = 1\n"), kHere, "max_speed_m_s"},
        BadDrive{"NegativeLimit", driven_text("", kDifferential + "max_speed_m_s = -1\n"), kHere,
                 "max_speed_m_s"},
        BadDrive{"LateralOfWheels", driven_text("", kDifferential + "max_lateral_m_s = 0.1\n"), kHere,
                 "omnidirectional"},
        BadDrive{"SlipOfAll", driven_text("", kDifferential + "left_slip = { mean = 2 }\n"), kHere,
                 "left_slip.mean"},
        BadDrive{"UnknownKeyOfSlip", driven_text("", kDifferential + "left_slip = { maen = 0 }\n"), kHere,
                 "mean"},
        BadDrive{"NoPath", driven_text("driven_by = 'path'\n"), kHere, "path"},
        BadDrive{"NoCommands", driven_text("driven_by = 'commands'\n"), kHere, "commands"},
        BadDrive{"CommandsAndPlugin", driven_text("driven_by = 'plugin'\ncommands = 'commands.csv'\n"), kHere,
                 "driven_by"},
        BadDrive{"PluginOfAPath",
                 driven_text("driven_by = 'commands'\ncommands = 'commands.csv'\ndriving_plugin = 'a'\n"),
                 kHere, "driving_plugin"},
        BadDrive{"NoSuchDriver", driven_text("driven_by = 'wind'\n"), kHere, "wind"},
        BadDrive{"WatchdogBelowZero", driven_text("watchdog_s = -1\n"), kHere, "watchdog_s"},
        BadDrive{"StartInAWall", driven_text(), start_at("0 495 50"), "overlaps"},
        BadDrive{"StartAboveNothing", driven_text(), start_at("0 900 50"), "no floor"},
        BadDrive{"NoSuchStart", driven_text("start = 'wets'\n"), start_at("0 0 50", "west"), "west"},
        BadDrive{"StartAndPath", driven_text("start = 'free'\npath = 'round'\nspeed_m_s = 1\n"), kHere,
                 "start"},
        BadDrive{"NoBody", "map = 'small.map'\nsteps = 4\n[robot]\n[robot.drive]\nkind = 'differential'\n",
                 kHere, "body"},
        BadDrive{"DriveKeyWithoutDrive", "map = 'small.map'\nsteps = 4\n[robot]\nwatchdog_s = 1\n", kHere,
                 "[robot.drive]"},
        BadDrive{"BumperWithoutDrive", "map = 'small.map'\nsteps = 4\n[robot]\n[sensor.a]\nkind = 'bump'\n",
                 kHere, "[robot.drive]"},
        BadDrive{"BumperWithoutZones",
                 driven_text("", kDifferential, "[sensor.b]\nkind = 'bump'\nzones = 0\n"), kHere, "zones"},
        BadDrive{"EncodersWithAView",
                 driven_text("", kDifferential, "[sensor.b]\nkind = 'encoders'\nnoise_m = 1\n"), kHere,
                 "noise_m"}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(SimulatedDrive, SettingsOfTheCommandLineReachTheDrive) {
  test::TempFolder folder;
  folder.write("small.map", test::map_text(room(), kHere));
  const auto file = folder.write("s.toml", driven_text());
  const std::vector<Override> overrides{{"robot.drive.kind", "tracked"},
                                        {"robot.drive.turn_slip", "0.25"},
                                        {"robot.drive.left_slip.mean", "0.1"},
                                        {"robot.watchdog_s", "0.5"}};
  const Scenario scenario = load_scenario(file, overrides);
  EXPECT_EQ(scenario.robot.driven->drive.kind, drive::DriveKind::kTracked);
  EXPECT_EQ(scenario.robot.driven->drive.turn_slip, 0.25);
  EXPECT_EQ(scenario.robot.driven->drive.left_slip.mean, 0.1);
  EXPECT_EQ(scenario.robot.driven->watchdog_ns, 500'000'000);
  const std::vector<Override> misspelt{{"robot.drive.max_sped_m_s", "1"}};
  const auto error = test::error_of([&] { load_scenario(file, misspelt); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code(), ErrorCode::kUsage);
  EXPECT_NE(std::string(error->what()).find("max_speed_m_s"), std::string::npos) << error->what();
}

}  // namespace
}  // namespace hallway::sim
