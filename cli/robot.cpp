// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "compiled_map.hpp"
#include "console.hpp"
#include "map/entity_schema.hpp"
#include "map/robot_file.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

/// A value of the robot and where it comes from.
struct Setting {
  std::string table;  ///< robot, drive, or sensor.NAME
  std::string key;
  std::string value;
  std::string origin;  ///< "robot file line N" or "default"
};

/// The unit that the end of a key's name says; empty where it says none.
std::string_view unit_of(std::string_view key) {
  using Unit = std::pair<std::string_view, std::string_view>;
  static constexpr std::array<Unit, 9> kUnits{{{"_rad_s2", "rad/s2"},
                                               {"_m_s2", "m/s2"},
                                               {"_rad_s", "rad/s"},
                                               {"_m_s", "m/s"},
                                               {"_rad", "rad"},
                                               {"_deg", "deg"},
                                               {"_hz", "Hz"},
                                               {"_m", "m"},
                                               {"_s", "s"}}};
  if (key.ends_with("_per_m")) return {};
  const auto found =
      std::ranges::find_if(kUnits, [&](const Unit& unit) { return key.ends_with(unit.first); });
  return found == kUnits.end() ? std::string_view() : found->second;
}

/// What the file says of a table, and then the defaults of its class.
void add_table(std::vector<Setting>& settings, const std::string& table, std::string_view classname,
               const std::vector<map::RobotKey>& keys, bool with_defaults) {
  for (const map::RobotKey& key : keys)
    settings.push_back({table, key.key, key.value, fmt::format("robot file line {}", key.line)});
  if (!with_defaults) return;
  const map::EntitySpec& spec = *map::find_entity_spec(classname);
  const auto kind = std::ranges::find(keys, spec.selector, &map::RobotKey::key);
  const std::string variant = !spec.selector.empty() && kind == keys.end()
                                  ? std::string(spec.key(spec.selector)->fallback)
                                  : (kind == keys.end() ? std::string() : kind->value);
  for (const map::KeySpec& key : spec.keys) {
    const bool is_given = std::ranges::find(keys, key.name, &map::RobotKey::key) != keys.end();
    if (is_given || key.fallback.empty() || !map::belongs(key, variant)) continue;
    settings.push_back({table, std::string(key.name), std::string(key.fallback), "default"});
  }
}

std::vector<Setting> settings_of(const map::RobotFile& robot) {
  std::vector<Setting> settings;
  add_table(settings, "robot", "hw_drive", robot.robot, false);
  if (robot.has_drive) add_table(settings, "drive", "hw_drive", robot.drive, true);
  for (const map::RobotSensor& sensor : robot.sensors)
    add_table(settings, "sensor." + sensor.name, "hw_sensor", sensor.keys, true);
  return settings;
}

// ---- text -----------------------------------------------------------------------------------------------------------

std::string range_text(double low_m, double high_m) {
  return fmt::format("{:.4g} to {:.4g} m", low_m, high_m);
}

std::string body_text(const map::RobotBody& body) {
  const std::string heights = range_text(body.bottom_m, body.top_m);
  if (body.is_cylinder()) return fmt::format("cylinder of radius {:.4g} m, z {}", body.radius_m, heights);
  Box box;
  for (const Vec3& corner : body.vertices) box.extend(corner);
  return fmt::format("brush of {} corners, x {}, y {}, z {}", body.vertices.size(),
                     range_text(box.min().x(), box.max().x()), range_text(box.min().y(), box.max().y()),
                     heights);
}

/// To a billionth, so that what was written comes back.
double degrees(double radians) {
  return std::round(radians * 180.0 / std::numbers::pi * 1e9) / 1e9;
}

std::string zone_text(const map::BumpZone& zone) {
  const std::string where =
      zone.region.empty() ? fmt::format("{:.4g} to {:.4g} deg", degrees(zone.from_rad), degrees(zone.to_rad))
                          : "in its brush";
  return where + ", z " + range_text(zone.bottom_m, zone.top_m);
}

std::string text_of(const map::RobotFile& robot) {
  std::string text = path_text(robot.file) + "\n";
  const auto row = [&](const std::string& name, const std::string& value, const std::string& origin) {
    text += fmt::format("  {:<32} {:<52} {}\n", name, value, origin);
  };
  const auto at = [](int line) { return fmt::format("robot file line {}", line); };
  row("body", body_text(robot.body), at(robot.body.line));
  for (const map::BumpZone& zone : robot.zones) row("zone " + zone.name, zone_text(zone), at(zone.line));
  std::string table;
  for (const Setting& setting : settings_of(robot)) {
    if (setting.table != table) text += "[" + setting.table + "]\n";
    table = setting.table;
    const std::string_view unit = unit_of(setting.key);
    row(printable(setting.key, 60),
        printable(setting.value, 60) + (unit.empty() ? "" : " " + std::string(unit)), setting.origin);
  }
  return text;
}

// ---- JSON -----------------------------------------------------------------------------------------------------------

Json json_of(const map::RobotBody& body) {
  Json corners = Json::array();
  for (const Vec3& corner : body.vertices) corners.push_back(place_json(corner));
  return {{"line", body.line},
          {"radius_m", body.is_cylinder() ? Json(body.radius_m) : Json(nullptr)},
          {"bottom_m", body.bottom_m},
          {"top_m", body.top_m},
          {"corners_m", corners}};
}

Json json_of(const map::BumpZone& zone) {
  const bool is_sector = zone.region.empty();
  return {{"name", zone.name},
          {"line", zone.line},
          {"from_deg", is_sector ? Json(degrees(zone.from_rad)) : Json(nullptr)},
          {"to_deg", is_sector ? Json(degrees(zone.to_rad)) : Json(nullptr)},
          {"bottom_m", zone.bottom_m},
          {"top_m", zone.top_m}};
}

Json document_of(const map::RobotFile& robot) {
  Json zones = Json::array(), settings = Json::array();
  for (const map::BumpZone& zone : robot.zones) zones.push_back(json_of(zone));
  for (const Setting& setting : settings_of(robot)) {
    settings.push_back({{"table", setting.table},
                        {"key", setting.key},
                        {"value", printable(setting.value)},
                        {"unit", std::string(unit_of(setting.key))},
                        {"origin", setting.origin}});
  }
  return {{"schema", "hallway.robot/1"}, {"status", 0},    {"file", path_text(robot.file)},
          {"body", json_of(robot.body)}, {"zones", zones}, {"settings", settings}};
}

struct RobotOptions {
  std::string file;
  bool json = false;
};

int show_robot(const RobotOptions& options) {
  const map::RobotFile robot = map::read_robot(load_map(options.file));
  if (options.json) {
    print_json(document_of(robot));
  } else {
    print_result(text_of(robot));
  }
  return 0;
}

}  // namespace

void add_robot_command(Command& app) {
  Command& command = app.command("robot", "Print what a robot file says, and where each value comes from");
  RobotOptions& options = command.runs(&show_robot);
  command.argument("file", &options.file, "A robot file: a .map with _hallway_robot 1")
      .required()
      .value("FILE");
  add_shared(command, Shared::kJson, &options.json);
  command.footer("Example: hallway robot maps/robots/cart.map");
}

}  // namespace hallway::cli
