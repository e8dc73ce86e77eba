// SPDX-License-Identifier: MIT
// Robot files that scenarios name: which value counts, and where it comes from.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "map/entity_schema.hpp"
#include "map/robot_file.hpp"
#include "sim/drive_keys.hpp"
#include "sim/robot_body.hpp"
#include "sim/scenario.hpp"
#include "sim/simulator.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/sim/robot_file_text.hpp"
#include "unit/sim/small_world.hpp"

namespace hallway::sim {
namespace {

using test::entity_text;
using test::key_text;
using test::kRoundBody;
using test::robot_text;

/// Of a robot that stays at its start. `robot` follows in [robot].
std::string robot_scenario(const std::string& robot = "", const std::string& more = "") {
  return "map = 'small.map'\nsteps = 4\n[robot]\nfile = 'robots/r.map'\n" + robot + more;
}

/// A folder with a scenario and its robot file.
struct Files {
  Files(const std::string& robot, const std::string& scenario) {
    std::filesystem::create_directory(folder / "robots");
    folder.write("robots/r.map", robot);
    file = folder.write("s.toml", scenario);
  }
  Scenario load(const std::vector<Override>& overrides = {}) const { return load_scenario(file, overrides); }

  test::TempFolder folder;
  std::filesystem::path file;
};

Setting noted_setting(const Scenario& scenario, const std::string& key) {
  const auto found = std::ranges::find(scenario.settings, key, &Setting::key);
  return found == scenario.settings.end() ? Setting{key, "none", "none"} : *found;
}

std::vector<std::string> names_of_sensors(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const SensorSpec& sensor : scenario.sensors)
    names.push_back(std::visit([](const auto& spec) { return spec.name; }, sensor));
  return names;
}

/// Three values of a key, as robot files have them: for the robot file, the scenario and the command line.
std::vector<std::string> values_of(const map::KeySpec& key) {
  if (key.kind == map::KeyKind::kFlag) return {"1", "0", "1"};
  if (key.kind == map::KeyKind::kVector) return {"0.1 0 0", "0.2 0 0", "0.3 0 0"};
  if (key.kind == map::KeyKind::kList) return {"0 0 1 0 0 1", "0 0 2 0 0 2", "0 0 3 0 0 3"};  // corners
  if (key.kind == map::KeyKind::kChoice) {
    std::vector<std::string> values;
    for (const std::string_view choice : split(key.choices, ' ')) values.emplace_back(choice);
    while (values.size() < 3) values.push_back(values.front());
    return values;
  }
  if (key.kind == map::KeyKind::kWhole && key.high < 4.0) return {"1", "2", "1"};
  if (key.kind == map::KeyKind::kWhole) return {"2", "3", "4"};
  std::vector<std::string> values;
  for (const double share : {0.25, 0.375, 0.4375})
    values.push_back(format_double(key.low + (key.high - key.low) * share));
  return values;
}

/// The value as a scenario has it.
std::string toml_of(const map::KeySpec& key, const std::string& value) {
  if (key.kind == map::KeyKind::kFlag) return value == "1" ? "true" : "false";
  if (key.kind == map::KeyKind::kChoice) return "'" + value + "'";
  if (key.kind != map::KeyKind::kVector && key.kind != map::KeyKind::kList) return value;
  std::string list = value;
  std::ranges::replace(list, ' ', ',');
  return "[" + list + "]";
}

/// The value as a setting is noted.
std::string noted(const map::KeySpec& key, const std::string& value) {
  if (key.kind == map::KeyKind::kFlag) return value == "1" ? "true" : "false";
  if (key.kind == map::KeyKind::kVector) return "[" + value.substr(0, value.find(' ')) + ", 0, 0]";
  if (key.kind == map::KeyKind::kList) return "[" + std::regex_replace(value, std::regex(" "), ", ") + "]";
  return value;
}

/// @param drive_key  of `hw_drive`
std::string setting_of_drive(const std::string& drive_key) {
  for (const std::string& table : kDisturbances) {
    if (drive_key.starts_with(table + "_"))
      return "robot.drive." + table + "." + drive_key.substr(table.size() + 1);
  }
  return (map::is_key_of_robot(drive_key) ? "robot." : "robot.drive.") + drive_key;
}

/// Each of file, scenario and command line gives the key in turn, and the one that is nearer to the user counts.
void expect_precedence(const map::KeySpec& key, const std::string& robot, const std::string& setting,
                       const std::string& more = "") {
  SCOPED_TRACE(setting);
  const std::vector<std::string> values = values_of(key);
  const std::size_t dot = setting.rfind('.');
  const std::string table = "[" + setting.substr(0, dot) + "]\n" + more;
  const std::string line =
      std::string(key.name) == setting.substr(dot + 1) ? std::string(key.name) : setting.substr(dot + 1);
  const std::string given = line + " = " + toml_of(key, values[1]) + "\n";
  const bool of_robot = setting.substr(0, dot) == "robot";
  const std::string written = of_robot ? robot_scenario(given) : robot_scenario("", table + given);
  const auto expect = [&](const Setting& found, std::size_t layer, const std::string& origin) {
    EXPECT_EQ(found.value, noted(key, values[layer]));
    EXPECT_TRUE(found.origin.starts_with(origin)) << found.origin;
  };
  const std::vector<Override> set{{setting, toml_of(key, values[2])}};
  const Files file_alone(robot, robot_scenario()), both(robot, written);
  expect(noted_setting(file_alone.load(), setting), 0, "r.map:");
  expect(noted_setting(both.load(), setting), 1, "s.toml:");
  expect(noted_setting(both.load(set), setting), 2, "command line");
  expect(noted_setting(file_alone.load(set), setting), 2, "command line");
}

TEST(RobotFiles, EachKeyOfTheDriveIsOfTheFileUnlessItIsGivenNearer) {
  for (const map::KeySpec& key : map::find_entity_spec("hw_drive")->keys) {
    const std::string name(key.name);
    std::string keys = key_text(name, values_of(key)[0]);
    if (name.starts_with("turn_slip")) keys += key_text("kind", "tracked");
    if (name == "max_lateral_m_s") keys += key_text("kind", "omnidirectional");
    if (name == "max_lateral_m_s" || name == "dead_band_m_s") keys += key_text("max_speed_m_s", "1000");
    if (name == "dead_band_rad_s") keys += key_text("max_angular_rad_s", "1000");
    const std::string robot = robot_text(kRoundBody + entity_text("hw_drive", keys));
    expect_precedence(key, robot, setting_of_drive(name));
  }
}

TEST(RobotFiles, EachKeyOfASensorIsOfTheFileUnlessItIsGivenNearer) {
  const map::EntitySpec& spec = *map::find_entity_spec("hw_sensor");
  std::set<std::string> seen;
  for (const std::string_view kind : split(spec.key("kind")->choices, ' ')) {
    for (const map::KeySpec& key : spec.keys) {
      if (key.name == "name" || key.name == "kind" || !map::belongs(key, kind)) continue;
      seen.insert(std::string(key.name));
      if (key.kind == map::KeyKind::kText) continue;  // a file, below
      std::string keys = key_text("name", "s") + key_text("kind", std::string(kind)) +
                         key_text(std::string(key.name), values_of(key)[0]);
      if (key.name == "min_range_m" || key.name == "near_m") keys += key_text("max_range_m", "1e6");
      if (key.name == "step_deg") keys += key_text("columns", "1");
      const std::string robot =
          robot_text(kRoundBody + entity_text("hw_drive", "") + entity_text("hw_sensor", keys));
      expect_precedence(key, robot, "sensor.s." + std::string(key.name));
    }
  }
  std::set<std::string> all{spec.keys.size() > 0 ? "kind" : ""};
  for (const map::KeySpec& key : spec.keys) all.insert(std::string(key.name));
  EXPECT_EQ(seen.size() + 2, all.size()) << "but for name and kind";
}

TEST(RobotFiles, APatternIsBesideTheFileThatNamesIt) {
  const std::string lidar = key_text("name", "s") + key_text("kind", "lidar") + key_text("rate_hz", "10") +
                            key_text("pattern", "beams.csv");
  const Files files(robot_text(kRoundBody + entity_text("hw_sensor", lidar)), robot_scenario());
  const auto beams = [&](const Scenario& scenario) {
    return std::get<sense::LidarSpec>(scenario.sensors.at(0)).pattern.rays.size();
  };
  const std::string head = "azimuth_deg,elevation_deg,t_s\n";
  files.folder.write("robots/beams.csv", head + "0,0,0\n");
  EXPECT_EQ(beams(files.load()), 1u);
  const Files nearer(robot_text(kRoundBody + entity_text("hw_sensor", lidar)),
                     robot_scenario("", "[sensor.s]\npattern = 'own.csv'\n"));
  nearer.folder.write("own.csv", head + "0,0,0\n1,0,0\n");
  EXPECT_EQ(beams(nearer.load()), 2u);
}

TEST(RobotFiles, TheBodyIsTheFilesUnlessTheScenarioHasAnother) {
  const Files round(robot_text(kRoundBody), robot_scenario());
  const auto cylinder = std::get<bsp::Cylinder>(*round.load().robot.body);
  EXPECT_EQ(cylinder.radius_m, 0.2);
  EXPECT_EQ(cylinder.z_low_m, 0.05);
  EXPECT_EQ(cylinder.z_high_m, 0.4);
  EXPECT_EQ(std::get<bsp::Cylinder>(*round.load({{"robot.radius_m", "0.3"}}).robot.body).z_high_m, 0.4);
  const auto box = std::get<bsp::UprightBox>(
      *round.load({{"robot.length_m", "0.5"}, {"robot.width_m", "0.3"}}).robot.body);
  EXPECT_EQ(box.half_length_m, 0.25);
  EXPECT_EQ(box.z_high_m, 0.4) << "the height is still the file's";

  const Files brush(robot_text("", test::block(-30, -20, 5, 30, 20, 40)), robot_scenario());
  EXPECT_NEAR(std::get<bsp::UprightBox>(*brush.load().robot.body).half_width_m, 0.2, 1e-12);
  EXPECT_EQ(std::get<bsp::Cylinder>(*brush.load({{"robot.radius_m", "0.3"}}).robot.body).radius_m, 0.3);
  EXPECT_EQ(noted_setting(brush.load(), "robot.length_m").value, "0.6");
}

TEST(RobotFiles, ABodyOfAnotherFormIsForDrives) {
  const std::string beside = test::block(-30, -20, 5, 40, 20, 40);
  const Files driven(robot_text(entity_text("hw_drive", ""), beside), robot_scenario());
  const Scenario scenario = driven.load();
  EXPECT_FALSE(scenario.robot.body.has_value());
  EXPECT_EQ(scenario.robot.hull.size(), 8u);
  EXPECT_NEAR(height_of(scenario.robot).first, 0.05, 1e-12);
  const contact::BodyShape shape = shape_of(scenario.robot, 0.02);
  EXPECT_NEAR(shape.bottom(), 0.02, 1e-12);
  EXPECT_NEAR(shape.extent(Vec3::UnitX()), 0.4, 1e-12);
  // Of a rectangle, about a point that is not its middle.
  EXPECT_NEAR(gyration_of(scenario.robot), std::sqrt(0.35 * 0.35 / 3 + 0.2 * 0.2 / 3 + 0.05 * 0.05), 1e-12);

  const Files still(robot_text("", beside), robot_scenario());
  const auto error = test::error_of([&] { still.load(); });
  ASSERT_TRUE(error.has_value());
  EXPECT_NE(error->message().find("needs a drive"), std::string::npos) << error->what();
  EXPECT_TRUE(error->where().file.ends_with("r.map"));
  EXPECT_EQ(error->where().line, 6);
}

std::string mounted_sensor(const std::string& name, const std::string& keys = "") {
  return entity_text("hw_sensor", key_text("name", name) + keys);
}

TEST(RobotFiles, TheSensorsOfTheFileComeFirstInItsOrder) {
  const Files files(robot_text(kRoundBody + mounted_sensor("b") + mounted_sensor("a")),
                    robot_scenario("", "[sensor.own]\nkind = 'points'\n[sensor.a]\nnoise_m = 0.1\n"));
  EXPECT_EQ(names_of_sensors(files.load()), (std::vector<std::string>{"b", "a", "own"}));
  EXPECT_EQ(names_of_sensors(files.load({{"sensor.a.rate_hz", "5"}})),
            (std::vector<std::string>{"b", "a", "own"}));
  const Scenario without = files.load({{"sensor.b.mounted", "false"}});
  EXPECT_EQ(names_of_sensors(without), (std::vector<std::string>{"a", "own"}));
  EXPECT_EQ(noted_setting(without, "sensor.b.mounted").value, "false");
  EXPECT_EQ(noted_setting(without, "sensor.b.kind").value, "none");
  EXPECT_FALSE(files.load({{"sensor.a.mounted", "false"}, {"sensor.b.mounted", "false"}}).takes_map_sensors);
  EXPECT_EQ(test::error_of([&] { files.load({{"sensor.c.rate_hz", "5"}}); })->code(), ErrorCode::kUsage);
}

TEST(RobotFiles, WithoutSensorsTheMapsCount) {
  EXPECT_TRUE(Files(robot_text(kRoundBody), robot_scenario()).load().takes_map_sensors);
  EXPECT_FALSE(
      Files(robot_text(kRoundBody + mounted_sensor("a")), robot_scenario()).load().takes_map_sensors);
}

TEST(RobotFiles, OfASensorWhoseKindTheScenarioChangesTheKeysOfTheNewKindAreTaken) {
  const Files files(
      robot_text(kRoundBody + mounted_sensor("a", key_text("max_range_m", "7") + key_text("roll_deg", "3"))),
      robot_scenario("", "[sensor.a]\nkind = 'planes'\n"));
  const auto planes = std::get<sense::PlaneSensorSpec>(files.load().sensors.front());
  EXPECT_EQ(planes.view.max_range_m, 7.0);
}

TEST(RobotFiles, OfADriveWhoseKindTheScenarioChangesTheKeysOfTheNewKindAreTaken) {
  const Files files(robot_text(kRoundBody + entity_text("hw_drive", key_text("kind", "tracked") +
                                                                        key_text("turn_slip", "0.2") +
                                                                        key_text("wheel_base_m", "0.4"))),
                    robot_scenario());
  const drive::DriveSpec spec = files.load({{"robot.drive.kind", "differential"}}).robot.driven->drive;
  EXPECT_EQ(spec.turn_slip, 0.0);
  EXPECT_EQ(spec.wheel_base_m, 0.4);
}

TEST(RobotFiles, BumpersHaveTheZonesOfTheFileUnlessANumberIsGiven) {
  const std::string zone =
      entity_text("hw_bump_zone", key_text("name", "front") + key_text("from_deg", "-30") +
                                      key_text("to_deg", "30") + key_text("top_m", "0.2"));
  const Files files(robot_text(kRoundBody + entity_text("hw_drive", "") + zone +
                               mounted_sensor("a", key_text("kind", "bump"))),
                    robot_scenario());
  const auto bump = std::get<sense::BumpSensorSpec>(files.load().sensors.front());
  ASSERT_EQ(bump.zones.size(), 1u);
  EXPECT_EQ(bump.zones[0].name, "front");
  EXPECT_EQ(bump.zones[0].top_m, 0.2);
  EXPECT_LT(bump.zones[0].bottom_m, 0.05 - 1.0) << "it reaches to the end of the body";
  const auto equal = std::get<sense::BumpSensorSpec>(files.load({{"sensor.a.zones", "6"}}).sensors.front());
  EXPECT_EQ(equal.zones.size(), 6u);
}

TEST(RobotFiles, TheCommandLineMayNameAnother) {
  const Files files(robot_text(kRoundBody), robot_scenario());
  const std::string other = files.folder.write(
      "other.map", robot_text(entity_text("hw_body", key_text("radius_m", "0.5") + key_text("bottom_m", "0") +
                                                         key_text("top_m", "1"))));
  const Scenario scenario = files.load({{"robot.file", other}});
  EXPECT_EQ(std::get<bsp::Cylinder>(*scenario.robot.body).radius_m, 0.5);
  EXPECT_EQ(scenario.robot_file, other);
}

TEST(RobotFiles, TheFolderOfARunHasACopy) {
  const test::TempFolder folder;
  const auto scenario = folder.write("scenario.toml", robot_scenario());
  const auto copy = folder.write("robot.map", robot_text(kRoundBody));
  EXPECT_EQ(load_scenario(scenario).robot_file, copy);
  EXPECT_EQ(test::error_of([&] { load_scenario(folder.write("s.toml", robot_scenario())); })->code(),
            ErrorCode::kIo);
}

struct BadRobot {
  const char* name;
  std::string entities;
  std::string scenario;
  std::string file;  ///< in which the fault is
  int line;
  std::string cause;
};

class BadRobots : public testing::TestWithParam<BadRobot> {};

TEST_P(BadRobots, AreRefusedWhereTheFaultIs) {
  const BadRobot& bad = GetParam();
  const Files files(
      bad.entities.starts_with("{\n\"classname\" \"worldspawn\"") ? bad.entities : robot_text(bad.entities),
      robot_scenario("", bad.scenario));
  const auto error = test::error_of([&] { files.load(); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_TRUE(error->where().file.ends_with(bad.file)) << error->what();
  EXPECT_EQ(error->where().line, bad.line) << error->what();
  EXPECT_NE(error->message().find(bad.cause), std::string::npos) << error->what();
}

std::string driven_by_key(const std::string& key, const std::string& value) {
  return kRoundBody + entity_text("hw_drive", key_text(key, value));
}

INSTANTIATE_TEST_SUITE_P(
    All, BadRobots,
    testing::Values(
        BadRobot{"AWorld", "{\n\"classname\" \"worldspawn\"\n}\n", "", "r.map", 0, "is no robot file"},
        BadRobot{"NoBody", mounted_sensor("a"), "", "r.map", 1, "has no body"},
        BadRobot{"TwoBodies", kRoundBody + kRoundBody, "", "r.map", 13, "a second body"},
        BadRobot{"OutOfRange", driven_by_key("max_speed_m_s", "1e300"), "", "r.map", 15,
                 "1e+300 is out of range: must be at least 0.001 and at most 1000"},
        BadRobot{"NotANumber", driven_by_key("max_speed_m_s", "nan"), "", "r.map", 15,
                 "is no finite decimal number"},
        BadRobot{"UnknownKey", driven_by_key("max_sped_m_s", "1"), "", "r.map", 15,
                 "unknown key `max_sped_m_s`"},
        BadRobot{"UnknownKind", driven_by_key("kind", "legs"), "", "r.map", 15, "unknown kind `legs`"},
        BadRobot{"UnknownKindOfSensor", kRoundBody + mounted_sensor("a", key_text("kind", "nose")), "",
                 "r.map", 16, "unknown kind `nose`"},
        BadRobot{"KeyOfAnotherKind",
                 kRoundBody + mounted_sensor("a", key_text("kind", "bump") + key_text("max_range_m", "3")),
                 "", "r.map", 17, "unknown key `max_range_m`"},
        BadRobot{"MoreZonesThanThereAre",
                 kRoundBody + mounted_sensor("a", key_text("kind", "bump") + key_text("zones", "65")), "",
                 "r.map", 17, "65 is out of range: must be at least 1 and at most 64"},
        BadRobot{"TwoSensorsOfAName", kRoundBody + mounted_sensor("a") + mounted_sensor("a"), "", "r.map", 19,
                 "a second sensor"},
        BadRobot{"ANoDrivesSlip", driven_by_key("turn_slip", "1"), "", "r.map", 13, "turn_slip"},
        BadRobot{"AScenariosRangeBelowTheFiles",
                 kRoundBody + mounted_sensor("a", key_text("min_range_m", "3")),
                 "[sensor.a]\nmax_range_m = 2\n", "r.map", 16, "is above max_range_m = 2"},
        BadRobot{"AScenariosValue", driven_by_key("max_speed_m_s", "1"),
                 "[robot.drive]\nmax_speed_m_s = 1e300\n", "s.toml", 6,
                 "is out of range: must be at least 0.001 and at most 1000"},
        BadRobot{"AScenariosKey", kRoundBody + mounted_sensor("a"), "[sensor.a]\nzones = 3\n", "s.toml", 6,
                 "unknown key"},
        BadRobot{"AScenariosOtherSensor", kRoundBody + mounted_sensor("a"), "[sensor.b]\nmounted = false\n",
                 "s.toml", 5, "is missing"},
        BadRobot{"NoTextForMounted", kRoundBody + mounted_sensor("a"), "[sensor.a]\nmounted = 'no'\n",
                 "s.toml", 6, "must be true or false"}),
    [](const testing::TestParamInfo<BadRobot>& bad) { return std::string(bad.param.name); });

TEST(RobotFiles, OneThatIsNotThereOrNoTextIsRefused) {
  const Files files(robot_text(kRoundBody), robot_scenario());
  const auto missing = test::error_of([&] { files.load({{"robot.file", "nowhere/r.map"}}); });
  ASSERT_TRUE(missing.has_value());
  EXPECT_EQ(missing->code(), ErrorCode::kIo);
  EXPECT_NE(std::string(missing->what()).find("nowhere/r.map"), std::string::npos) << missing->what();
  const auto number = test::error_of([&] { files.load({{"robot.file", "3"}}); });
  ASSERT_TRUE(number.has_value());
  EXPECT_EQ(number->code(), ErrorCode::kUsage);
  EXPECT_NE(number->message().find("must be a text"), std::string::npos) << number->what();
  EXPECT_TRUE(test::error_of([&] {
                files.load({{"robot.file", files.folder.path().string()}});
              }).has_value())
      << "a folder";
}

TEST(RobotFiles, OneThatIsTakenForAMapIsRefused) {
  const Files files(robot_text(kRoundBody), robot_scenario());
  const Scenario scenario = files.load({{"map", (files.folder / "robots/r.map").string()}});
  const auto error =
      test::error_of([&] { const Simulator simulator(scenario, 1, trace::Backend::kBruteForce); });
  ASSERT_TRUE(error.has_value());
  EXPECT_NE(error->message().find("is a robot file and no map"), std::string::npos) << error->what();
}

}  // namespace
}  // namespace hallway::sim
