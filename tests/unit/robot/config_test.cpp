// SPDX-License-Identifier: MIT
#include "robot/config.hpp"

#include <gtest/gtest.h>

#include "robot/session.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway::robot {
namespace {

using std::chrono::milliseconds;

const std::string kWhole = R"([driver]
name = "udp"
port = 7000
address = "0.0.0.0"
lossy = true

[[plugin]]
name = "slam_point"
params = { noise_m = 0.05 }

[limits]
call_timeout_s = 2.5
memory_limit_mib = 256
on_failure = "restart"

[robot]
watchdog_ms = 80
rate_hz = 50
report_every_s = 1
command_timeout_s = 0.5
record = false
)";

Config load(const std::string& text, const std::vector<Override>& overrides = {}) {
  const test::TempFolder folder;
  return load_config(folder.write("robot.toml", text), overrides);
}

TEST(Config, IsReadAsItStands) {
  const Config config = load(kWhole);
  EXPECT_EQ(config.name(), "robot");
  EXPECT_EQ(config.driver.name, "udp");
  ASSERT_EQ(config.driver.settings.size(), 3u);
  EXPECT_EQ(config.driver.settings[0].key + "=" + config.driver.settings[0].value, "port=7000");
  EXPECT_EQ(config.driver.settings[0].where.line, 3);
  EXPECT_EQ(config.driver.settings[2].value, "true");
  EXPECT_EQ(config.pipeline.at(0).parameters.at(0).value, "0.05");
  EXPECT_EQ(config.limits.call_timeout_s, 2.5);
  EXPECT_EQ(config.limits.memory_mib, 256u);
  EXPECT_EQ(config.limits.on_failure, host::OnFailure::kRestart);
  EXPECT_EQ(config.watchdog, milliseconds(80));
  EXPECT_EQ(config.rate_hz, 50.0);
  EXPECT_EQ(config.report_every_s, 1.0);
  EXPECT_EQ(config.command_timeout_s, 0.5);
  EXPECT_FALSE(config.record);
}

TEST(Config, WhatIsNotSaidHasDefaults) {
  const Config config = load("[driver]\nname = 'replay'\n[[plugin]]\nname = 'p'\n");
  EXPECT_FALSE(config.watchdog);
  EXPECT_FALSE(config.rate_hz);
  EXPECT_TRUE(config.record);
  EXPECT_EQ(config.command_timeout_s, 0.0);
  EXPECT_EQ(config.limits.call_timeout_s, 10.0);
  EXPECT_EQ(config.limits.on_failure, host::OnFailure::kStop);
}

TEST(Config, TheCommandLineStandsAboveTheFile) {
  const Config config = load(kWhole, {{"driver.port", "7001"},
                                      {"robot.rate_hz", "20"},
                                      {"limits.on_failure", "stop"},
                                      {"slam_point.noise_m", "0.2"}});
  EXPECT_EQ(config.driver.settings.at(0).value, "7001");
  EXPECT_EQ(config.driver.settings.at(0).where.file, "command line");
  EXPECT_EQ(config.rate_hz, 20.0);
  EXPECT_EQ(config.limits.on_failure, host::OnFailure::kStop);
  EXPECT_EQ(config.pipeline.at(0).parameters.at(0).value, "0.2");
}

const std::string kParts =
    "[drive]\nkind = 'ackermann'\nmax_speed_m_s = 0.75\nlatency_s = 0\n[body]\nlength_m = 0.5\nwidth_m = "
    "0.25\ntop_m = 0.5\n";

TEST(Config, DriveAndBodyOverrideTheDriversNumberByNumber) {
  host::RobotInfo robot;
  robot.drive = host::DriveInfo{.kind = HW_DRIVE_TRACKED, .max_speed_m_s = 2.0, .wheel_base_m = 0.3};
  robot.body = host::BodyInfo{.radius_m = 0.9, .bottom_m = 0.125};
  const Config config = load(kWhole + kParts, {{"drive.max_angular_rad_s", "1.5"}});
  override_parts(config.parts, robot);
  EXPECT_EQ(robot.drive->kind, std::uint32_t{HW_DRIVE_ACKERMANN});
  EXPECT_EQ(robot.drive->max_speed_m_s, 0.75);
  EXPECT_EQ(robot.drive->latency_s, 0.0);
  EXPECT_EQ(robot.drive->max_angular_rad_s, 1.5);
  EXPECT_EQ(robot.drive->wheel_base_m, 0.3) << "the driver's";
  EXPECT_EQ(robot.body->corners, (std::vector<std::array<double, 2>>{
                                     {0.25, 0.125}, {-0.25, 0.125}, {-0.25, -0.125}, {0.25, -0.125}}));
  EXPECT_EQ(robot.body->bottom_m, 0.125) << "the driver's";
  EXPECT_EQ(robot.body->top_m, 0.5);
}

TEST(Config, DriveAndBodyAreKnownWhereTheDriverSaysNothing) {
  host::RobotInfo robot;
  override_parts(load(kWhole).parts, robot);
  EXPECT_FALSE(robot.drive || robot.body);
  override_parts(load(kWhole + "[drive]\nmax_speed_m_s = 1\n").parts, robot);
  ASSERT_TRUE(robot.drive);
  EXPECT_FALSE(robot.body);
  EXPECT_EQ(robot.drive->kind, std::uint32_t{HW_DRIVE_UNKNOWN});
  override_parts(load(kWhole + "[body]\nradius_m = 0.25\n").parts, robot);
  ASSERT_TRUE(robot.body);
  EXPECT_EQ(robot.body->radius_m, 0.25);
}

TEST(Config, ABodyThatDoesNotFitTheDriversIsRefused) {
  host::RobotInfo robot;
  robot.body = host::BodyInfo{.radius_m = 0.9, .bottom_m = 0.75};
  const Config config = load(kWhole + kParts);
  const auto error = test::error_of([&] { override_parts(config.parts, robot); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_TRUE(error->where().file.ends_with("robot.toml")) << error->what();
  EXPECT_NE(std::string(error->what()).find("body.top_m"), std::string::npos) << error->what();
}

TEST(Config, AnotherDriverHasNoSettingsOfTheFirst) {
  EXPECT_TRUE(load(kWhole, {{"driver", "replay"}}).driver.settings.empty());
  EXPECT_EQ(load(kWhole, {{"driver.log", "x"}, {"driver", "replay"}}).driver.settings.size(), 1u);
  EXPECT_EQ(load(kWhole, {{"driver", "build/udp.so"}}).driver.settings.size(), 3u)
      << "the same one, from a file";
}

TEST(Config, AnotherPluginStandsAlone) {
  const Config config = load(kWhole, {{"plugin", "other"}});
  ASSERT_EQ(config.pipeline.size(), 1u);
  EXPECT_EQ(config.pipeline[0].plugin, "other");
}

TEST(Config, FilesAreNamedFromItsFolder) {
  const test::TempFolder folder;
  const auto file =
      folder.write("robot.toml", "[driver]\nname = 'd/mine.so'\n[[plugin]]\nname = 'p/slam.so'\n");
  const Config config = load_config(file);
  EXPECT_EQ(config.driver.name, (folder / "d/mine.so").string());
  EXPECT_EQ(config.pipeline.at(0).plugin, (folder / "p/slam.so").string());
  EXPECT_EQ(config.folder(), folder.path());
}

struct Wrong {
  const char* name;
  std::string text;
  int line;
  const char* element;
  const char* says;
};

class WrongConfig : public testing::TestWithParam<Wrong> {};

TEST_P(WrongConfig, IsRefusedWithFileLineAndKey) {
  const Wrong& wrong = GetParam();
  const auto error = test::error_of([&] { load(wrong.text); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_TRUE(error->where().file.ends_with("robot.toml")) << error->what();
  EXPECT_EQ(error->where().line, wrong.line) << error->what();
  EXPECT_NE(std::string(error->what()).find(wrong.element), std::string::npos) << error->what();
  EXPECT_NE(std::string(error->what()).find(wrong.says), std::string::npos) << error->what();
}

const std::string kDriver = "[driver]\nname = 'd'\n";
const std::string kBoth = kDriver + "[[plugin]]\nname = 'p'\n";

INSTANTIATE_TEST_SUITE_P(
    All, WrongConfig,
    testing::Values(
        Wrong{"NoDriver", "[[plugin]]\nname = 'p'\n", 1, "driver.name", "is missing"},
        Wrong{"NoPlugin", kDriver, 1, "plugin", "is missing"},
        Wrong{"DriverIsText", "driver = 'd'\n", 1, "driver", "must be a table"},
        Wrong{"DriverWithoutName", "[driver]\nport = 1\n", 1, "driver.name", "is missing"},
        Wrong{"SettingIsList", kDriver + "port = [1]\n", 3, "driver.port", "not a list"},
        Wrong{"UnknownDrive", kBoth + "[drive]\nkind = 'legs'\n", 6, "drive.kind", "differential"},
        Wrong{"NegativeSpeed", kBoth + "[drive]\nmax_speed_m_s = -1\n", 6, "drive.max_speed_m_s", ""},
        Wrong{"UnknownLimitOfDrive", kBoth + "[drive]\nmax_sped_m_s = 1\n", 6, "drive.max_sped_m_s",
              "did you mean \"max_speed_m_s\"?"},
        Wrong{"RoundBox", kBoth + "[body]\nradius_m = 1\nlength_m = 1\n", 6, "body.radius_m", "round"},
        Wrong{"BoxWithoutWidth", kBoth + "[body]\nlength_m = 1\n", 5, "body.width_m", "is missing"},
        Wrong{"UnknownTable", kBoth + "[limit]\n", 5, "limit", "did you mean \"limits\"?"},
        Wrong{"UnknownLimit", kBoth + "[limits]\nmemory_mib = 1\n", 6, "limits.memory_mib", "unknown key"},
        Wrong{"UnknownPolicy", kBoth + "[limits]\non_failure = 'stp'\n", 6, "limits.on_failure", "stop"},
        Wrong{"UnknownOfRobot", kBoth + "[robot]\nwatchdg_ms = 5\n", 6, "robot.watchdg_ms",
              "did you mean \"watchdog_ms\"?"},
        Wrong{"NoTimeForTheWatchdog", kBoth + "[robot]\nwatchdog_ms = 0\n", 6, "robot.watchdog_ms",
              "out of range"},
        Wrong{"NoTimeForACommand", kBoth + "[robot]\ncommand_timeout_s = -1\n", 6, "robot.command_timeout_s",
              "out of range"},
        Wrong{"NoRate", kBoth + "[robot]\nrate_hz = 0\n", 6, "robot.rate_hz", "out of range"},
        Wrong{"RecordIsText", kBoth + "[robot]\nrecord = 'yes'\n", 6, "robot.record", "true or false"},
        Wrong{"OtherSchema", "schema = 'hallway.robot/9'\n" + kBoth, 1, "schema", "hallway.robot/1"},
        Wrong{"PluginTwice", kBoth + "[[plugin]]\nname = 'x/p.so'\n", 6, "plugin[2].name", "stands twice"},
        Wrong{"NoToml", "driver = \n", 1, "", ""}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(Config, AnUnknownSettingOfTheCommandLineHasASuggestion) {
  const auto error = test::error_of([] { load(kWhole, {{"robot.rate", "5"}}); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kUsage);
  EXPECT_NE(std::string(error->what()).find("robot.rate_hz"), std::string::npos) << error->what();
}

Timing timing(std::optional<int> watchdog_ms, std::optional<double> rate_hz, int period_ms,
              bool lock_step = false) {
  Config config;
  if (watchdog_ms) config.watchdog = milliseconds(*watchdog_ms);
  config.rate_hz = rate_hz;
  host::RobotInfo robot;
  robot.period_ns = std::int64_t{period_ms} * 1'000'000;
  robot.lock_step = lock_step;
  return timing_of(config, robot);
}

TEST(Timing, TheWatchdogWaitsForTwoPeriodsAnd50MsAtLeast) {
  EXPECT_EQ(timing({}, {}, 100).watchdog, milliseconds(200));
  EXPECT_EQ(timing({}, {}, 5).watchdog, milliseconds(50));
  EXPECT_EQ(timing({}, 10.0, 5).watchdog, milliseconds(200)) << "the schedule's period counts";
  EXPECT_EQ(timing({}, {}, 0).watchdog, milliseconds(500));
  EXPECT_EQ(timing(7, {}, 100).watchdog, milliseconds(7));
}

TEST(Timing, TheDeadlineIsAPeriod) {
  EXPECT_EQ(timing({}, {}, 100).deadline, Clock::duration(milliseconds(100)));
  EXPECT_EQ(timing({}, 200.0, 100).deadline, Clock::duration(milliseconds(5)));
  EXPECT_FALSE(timing({}, {}, 0).deadline);
}

TEST(Timing, LockStepLooksAtNoClockAndSaysSo) {
  const Timing lock_step = timing(7, 10.0, 100, true);
  EXPECT_EQ(lock_step.watchdog, Clock::duration::zero());
  EXPECT_FALSE(lock_step.tick);
  EXPECT_FALSE(lock_step.deadline);
  EXPECT_EQ(lock_step.warnings.size(), 2u);
  EXPECT_TRUE(timing({}, {}, 100, true).warnings.empty());
}

}  // namespace
}  // namespace hallway::robot
