// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <variant>

#include "base/text.hpp"
#include "map/entity_schema.hpp"
#include "map/sensors.hpp"
#include "sim/drive_keys.hpp"
#include "sim/scenario.hpp"
#include "sim/schema.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/sim/small_world.hpp"

namespace hallway::sim {
namespace {

using Names = std::set<std::string>;

Scenario scenario_with(const std::string& more) {
  const test::TempFolder folder;
  return load_scenario(folder.write("s.toml", test::scenario_text(more)));
}

/// The keys of a class of maps that a variant of it has.
Names keys_of_class(std::string_view classname, std::string_view variant) {
  Names names;
  for (const map::KeySpec& key : map::find_entity_spec(classname)->keys) {
    if (map::belongs(key, variant)) names.insert(std::string(key.name));
  }
  return names;
}

/// The key as a line of a scenario, with the default that maps have.
std::string line_of(const map::KeySpec& key) {
  std::string value(key.fallback);
  if (key.kind == map::KeyKind::kChoice) value = "\"" + value + "\"";
  if (key.kind == map::KeyKind::kFlag) value = value == "1" ? "true" : "false";
  return std::string(key.name) + " = " + value + "\n";
}

/// A sensor of each kind, and each of its keys: its default is what counts without it, and a number out of range is refused by name.
TEST(KeyTables, EachKeyOfEachKindOfSensorIsReadWithItsRangeAndDefault) {
  int refused = 0;
  for (const map::SensorKind& kind : map::sensor_kinds()) {
    const std::string table = "[sensor.s]\nkind = \"" + std::string(kind.name) + "\"\n";
    const std::string drive = kind.name == "bump" ? "[robot.drive]\nkind = \"differential\"\n" : "";
    const auto bare = scenario_with(drive + table).settings;
    for (const std::string& name : map::sensor_key_names(kind.name)) {
      SCOPED_TRACE(std::string(kind.name) + ": " + name);
      const map::KeySpec& key = map::sensor_key(kind.name, name);
      if (name == "kind") continue;
      const std::string full = "sensor.s." + name;
      if (!key.fallback.empty() && key.kind != map::KeyKind::kVector) {
        const auto settings = scenario_with(drive + table + line_of(key)).settings;
        const auto of = [&](const std::vector<Setting>& all) {
          const auto found = std::ranges::find(all, full, &Setting::key);
          return found == all.end() ? std::string() : found->value;
        };
        EXPECT_NE(of(settings), "") << "it is read";
        if (of(bare) != "") {
          EXPECT_EQ(of(settings), of(bare));
        }
      }
      if (key.kind != map::KeyKind::kNumber && key.kind != map::KeyKind::kWhole) continue;
      for (const double value : {key.low - 1.0, 2.0 * key.high + 1.0}) {
        const std::string line =
            name + " = " +
            (key.kind == map::KeyKind::kWhole ? std::to_string(std::llround(value)) : format_double(value)) +
            "\n";
        const auto error = test::error_of([&] { scenario_with(drive + table + line); });
        ASSERT_TRUE(error) << line;
        EXPECT_NE(std::string(error->what()).find(full), std::string::npos) << error->what();
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 150);
}

TEST(KeyTables, TheDrivesOfRobotFilesAndOfScenariosHaveTheSameKeys) {
  Names names;
  for (const std::string& key : kDriveKeys) {
    const bool is_table = std::ranges::find(kDisturbances, key) != kDisturbances.end();
    if (!is_table) names.insert(key);
    if (is_table)
      for (const std::string& part : kDisturbanceKeys) names.insert(key + "_" + part);
  }
  const Names of_file = keys_of_class("hw_drive", "");
  Names of_robot;
  std::ranges::set_difference(of_file, names, std::inserter(of_robot, of_robot.end()));
  EXPECT_EQ(of_robot, (Names{"clearance_m", "contact", "ledge_m", "ledges", "slope_deg", "step_m"}));
  for (const std::string& key : of_robot)
    EXPECT_NE(std::ranges::find(kDrivenKeys, key), kDrivenKeys.end()) << key;
  for (const std::string& key : names) EXPECT_TRUE(of_file.contains(key)) << key;
}

TEST(KeyTables, ADriveHasTheDefaultsOfRobotFiles) {
  std::string robot, drive;
  for (const map::KeySpec& key : map::find_entity_spec("hw_drive")->keys) {
    if (key.fallback.empty()) continue;
    const std::string name(key.name);
    if (std::ranges::find(kDriveKeys, name) != kDriveKeys.end()) drive += line_of(key);
    if (std::ranges::find(kDrivenKeys, name) != kDrivenKeys.end()) robot += line_of(key);
    for (const std::string& table : kDisturbances) {
      if (name.starts_with(table)) {
        EXPECT_EQ(key.fallback, "0") << "a disturbance is none by default";
      }
    }
  }
  const DrivenSpec written = *scenario_with(robot + "[robot.drive]\n" + drive).robot.driven;
  const DrivenSpec bare = *scenario_with("[robot.drive]\nkind = \"differential\"\n").robot.driven;
  EXPECT_EQ(written.drive, bare.drive);
  EXPECT_EQ(written.clearance_m, bare.clearance_m);
  EXPECT_EQ(written.step_m, bare.step_m);
  EXPECT_EQ(written.ledge_m, bare.ledge_m);
  EXPECT_EQ(written.falls, bare.falls);
  EXPECT_EQ(written.slides, bare.slides);
}

TEST(KeyTables, BumpersAndEncodersHaveTheDefaultsOfRobotFiles) {
  const auto written = [](const std::string& kind) {
    std::string text = "[sensor.s]\nkind = \"" + kind + "\"\n";
    for (const map::KeySpec& key : map::find_entity_spec("hw_sensor")->keys) {
      if (key.variant == kind && !key.fallback.empty()) text += line_of(key);
    }
    return scenario_with(text).sensors.front();
  };
  const auto bump = std::get<sense::BumpSensorSpec>(written("bump"));
  EXPECT_EQ(bump.depth, sense::BumpSensorSpec{}.depth);
  EXPECT_EQ(bump.skin_m, sense::BumpSensorSpec{}.skin_m);
  EXPECT_EQ(bump.missed_rate, sense::BumpSensorSpec{}.missed_rate);
  EXPECT_EQ(bump.false_rate, sense::BumpSensorSpec{}.false_rate);
  const auto encoders = std::get<EncoderSpec>(written("encoders"));
  EXPECT_EQ(encoders.ticks_per_revolution, sense::EncoderSensorSpec{}.ticks_per_revolution);
  EXPECT_EQ(encoders.radius_error_sigma, sense::EncoderSensorSpec{}.radius_error_sigma);
}

}  // namespace
}  // namespace hallway::sim
