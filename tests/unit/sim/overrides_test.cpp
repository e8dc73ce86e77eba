// SPDX-License-Identifier: MIT
#include "sim/overrides.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "sim/scenario.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/sim/small_world.hpp"

namespace hallway::sim {
namespace {

const char* const kRest =
    "[sensor.eyes]\nkind = 'points'\nnoise_m = 0.05\n"
    "[[plugin]]\nname = 'em'\n[[plugin]]\nname = 'slam_point'\nparams = {noise_m = 0.05}\n";

Scenario load_with(const std::vector<Override>& overrides) {
  const test::TempFolder folder;
  return load_scenario(folder.write("s.toml", test::scenario_text(kRest)), overrides);
}

std::string origin_of(const Scenario& scenario, const std::string& key) {
  const auto found = std::find_if(scenario.settings.begin(), scenario.settings.end(),
                                  [&](const Setting& entry) { return entry.key == key; });
  return found == scenario.settings.end() ? "none" : found->origin;
}

/// The override must be refused as wrong use, naming its key and `cause`.
void expect_refused(const Override& setting, const std::string& cause) {
  const auto error = test::error_of([&] { load_with({setting}); });
  ASSERT_TRUE(error.has_value()) << setting.key;
  EXPECT_EQ(error->code(), ErrorCode::kUsage);
  EXPECT_EQ(error->where().file, "command line");
  EXPECT_EQ(error->where().element, "key `" + setting.key + "`");
  EXPECT_NE(error->message().find(cause), std::string::npos) << error->what();
}

TEST(Overrides, SetKeysOfTheMapsClouds) {
  const Scenario scenario = load_with(
      {{"cloud.crowd.moving_share", "0.25"}, {"cloud.crowd.motion", "group"}, {"cloud.x.seed", "3"}});
  ASSERT_EQ(scenario.clouds.size(), 2u);
  EXPECT_EQ(scenario.clouds[0].name, "crowd");
  ASSERT_EQ(scenario.clouds[0].keys.size(), 2u);
  EXPECT_EQ(scenario.clouds[0].keys[0].key, "moving_share");
  EXPECT_EQ(scenario.clouds[0].keys[0].value, "0.25");
  EXPECT_EQ(scenario.clouds[0].keys[1].value, "group");
  EXPECT_EQ(scenario.clouds[1].keys[0].value, "3");
  EXPECT_EQ(origin_of(scenario, "cloud.crowd.moving_share"), "command line");
  expect_refused({"cloud.crowd.moving_share", "1.5"}, "1.5");
  expect_refused({"cloud.crowd.path", "round"}, "no such setting");
}

TEST(Overrides, StandAboveTheFile) {
  const Scenario scenario = load_with({{"seed", "7"}, {"steps", "3"}, {"period_s", "0.5"}});
  EXPECT_EQ(scenario.seed, 7u);
  EXPECT_EQ(scenario.steps, 3u);
  EXPECT_EQ(scenario.period_ns, 500'000'000);
  EXPECT_EQ(origin_of(scenario, "seed"), "command line");
  EXPECT_EQ(origin_of(scenario, "map"), "s.toml:1");
}

TEST(Overrides, SetTheLimitsOfPlugins) {
  const Scenario scenario = load_with({{"call_timeout_s", "2"}, {"on_failure", "continue"}});
  EXPECT_EQ(scenario.limits.call_timeout_s, 2.0);
  EXPECT_EQ(scenario.limits.on_failure, OnFailure::kContinue);
  EXPECT_EQ(origin_of(scenario, "on_failure"), "command line");
}

TEST(Overrides, TheLaterOfTwoCounts) {
  EXPECT_EQ(load_with({{"seed", "7"}, {"seed", "8"}}).seed, 8u);
}

TEST(Overrides, SetASensor) {
  const Scenario scenario =
      load_with({{"sensor.eyes.noise_m", "[1, 2, 3]"}, {"sensor.eyes.max_range_m", "4"}});
  EXPECT_EQ(std::get<sense::PointSensorSpec>(scenario.sensors.at(0)).noise_m, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<sense::PointSensorSpec>(scenario.sensors.at(0)).max_range_m, 4.0);
  EXPECT_EQ(origin_of(scenario, "sensor.eyes.max_range_m"), "command line");
}

TEST(Overrides, TakeBareWordsAsText) {
  EXPECT_EQ(load_with({{"robot.path", "other way"}}).robot.path, "other way");
}

TEST(Overrides, OfSpeedDisplacesLoopSteps) {
  const Scenario scenario = load_with({{"robot.speed_m_s", "2"}});
  EXPECT_EQ(scenario.robot.speed_m_s, 2.0);
  EXPECT_FALSE(scenario.robot.loop_steps.has_value());
}

TEST(Overrides, AMapCountsFromTheCurrentFolder) {
  EXPECT_EQ(load_with({{"map", "sub/other.map"}}).map_file, "sub/other.map");
}

TEST(Overrides, SetAPluginsParameter) {
  const Scenario scenario =
      load_with({{"slam_point.noise_m", "0.1"}, {"slam_point.window", "20"}, {"em.mode", "fast"}});
  const auto& params = scenario.pipeline.at(1).parameters;
  ASSERT_EQ(params.size(), 2u);
  EXPECT_EQ(params[0].value, "0.1");
  EXPECT_EQ(params[0].where.file, "command line");
  EXPECT_EQ(params[1].name, "window");
  EXPECT_EQ(scenario.pipeline.at(0).parameters.at(0).value, "fast");
  EXPECT_EQ(origin_of(scenario, "slam_point.noise_m"), "command line");
}

TEST(Overrides, AParameterOfTheOnlyPluginNeedsNoName) {
  EXPECT_EQ(load_with({{"plugin", "slam_point"}, {"noise_m", "0.1"}}).pipeline.at(0).parameters.at(0).value,
            "0.1");
  expect_refused({"noise_m", "0.1"}, "PLUGIN.KEY");  // which of the two?
}

TEST(Overrides, APluginReplacesThePipeline) {
  const Scenario scenario = load_with({{"plugin", "other"}});
  ASSERT_EQ(scenario.pipeline.size(), 1u);
  EXPECT_EQ(scenario.pipeline[0].plugin, "other");
  EXPECT_TRUE(scenario.pipeline[0].parameters.empty());
  EXPECT_EQ(origin_of(scenario, "plugin[1].name"), "command line");
}

TEST(Overrides, AnotherBuildOfAPluginKeepsItsParameters) {
  const Scenario scenario = load_with({{"slam_point.noise_m", "0.2"}, {"plugin", "build/slam_point.so"}});
  ASSERT_EQ(scenario.pipeline.size(), 1u);
  EXPECT_EQ(scenario.pipeline[0].plugin, "build/slam_point.so");
  EXPECT_EQ(scenario.pipeline[0].parameters.at(0).value, "0.2");
}

TEST(Overrides, ANewPluginCanBeGivenParameters) {
  EXPECT_EQ(load_with({{"other.a", "1"}, {"plugin", "other"}}).pipeline.at(0).parameters.at(0).value, "1");
}

TEST(Overrides, RefuseUnknownKeysWithASuggestion) {
  expect_refused({"sed", "7"}, "did you mean \"seed\"?");
  expect_refused({"robot.sped_m_s", "7"}, "did you mean \"robot.speed_m_s\"?");
  expect_refused({"sensor.eye.noise_m", "7"}, "did you mean \"sensor.eyes.noise_m\"?");
  expect_refused({"sensor.eyes.nois_m", "7"}, "did you mean \"sensor.eyes.noise_m\"?");
  expect_refused({"slam_pont.noise_m", "7"}, "did you mean \"slam_point.noise_m\"?");
  expect_refused({"robot", "7"}, "no such setting");
  expect_refused({"", "7"}, "no such setting");
  expect_refused({".", "7"}, "no such setting");
  expect_refused({"slam_point.", "7"}, "no such setting");
}

TEST(Overrides, RefuseWrongValuesAsWrongUse) {
  expect_refused({"seed", "x"}, "must be a whole number, not a text");
  expect_refused({"steps", "0"}, "out of range");
  expect_refused({"sensor.eyes.noise_m", "-1"}, "out of range");
  expect_refused({"slam_point.noise_m", "[1]"}, "not a list");
  expect_refused({"robot.speed_m_s", "1e400"}, "must be a number");
}

TEST(Overrides, LeaveAFileThatIsWrongToTheReader) {
  const test::TempFolder folder;
  const std::vector<Override> overrides{{"robot.path", "x"}};
  const auto file = folder.write("s.toml", "map = 'm'\nsteps = 1\nrobot = 3\n");
  const auto error = test::error_of([&] { load_scenario(file, overrides); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->where().line, 3);
}

}  // namespace
}  // namespace hallway::sim
