// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <variant>

#include "base/error.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "compiled_map.hpp"
#include "console.hpp"
#include "map/robot_file.hpp"
#include "robot_settings.hpp"
#include "scenario_input.hpp"
#include "shared_options.hpp"
#include "sim/robot_body.hpp"

namespace hallway::cli {
namespace {

struct Body {
  map::RobotBody shape;
  std::string origin;
};

/// What is printed of a robot.
struct Robot {
  std::string file{};        ///< that was asked for
  std::string robot_file{};  ///< that it is, or that it names; empty: none
  std::string map{};         ///< of a scenario
  std::optional<Body> body{};
  std::vector<map::BumpZone> zones{};
  std::vector<RobotSetting> settings{};
};

Robot robot_of(const std::string& file) {
  const map::RobotFile robot = map::read_robot(load_map(file));
  return {.file = file,
          .robot_file = file,
          .body = Body{robot.body, robot_file_line(robot.body.line)},
          .zones = robot.zones,
          .settings = settings_of(robot)};
}

std::string origin_of(const std::vector<RobotSetting>& settings, const std::string& key) {
  const auto found = std::ranges::find_if(
      settings, [&](const RobotSetting& setting) { return setting.table == "robot" && setting.key == key; });
  return found == settings.end() ? std::string() : found->origin;
}

/// Of a scenario: from its keys, or the file's where that is of another form.
std::optional<Body> body_of(const sim::RobotSpec& robot, const std::optional<map::RobotFile>& file,
                            const std::vector<RobotSetting>& settings) {
  if (!robot.hull.empty()) return Body{file->body, robot_file_line(file->body.line)};
  if (!robot.body) return std::nullopt;
  Body body;
  std::tie(body.shape.bottom_m, body.shape.top_m) = sim::height_of(robot);
  for (const Vec2& corner : sim::outline_of(robot)) {
    for (const double z : {body.shape.bottom_m, body.shape.top_m})
      body.shape.vertices.emplace_back(corner.x(), corner.y(), z);
  }
  if (const auto* cylinder = std::get_if<bsp::Cylinder>(&*robot.body))
    body.shape.radius_m = cylinder->radius_m;
  body.origin = origin_of(settings, body.shape.is_cylinder() ? "radius_m" : "length_m");
  const std::string own = "robot file line ";
  if (body.origin.starts_with(own)) body.shape.line = file->body.line;
  return body;
}

Robot robot_of(const std::string& file, const std::vector<Override>& overrides) {
  const sim::Scenario scenario = sim::load_scenario(file, overrides);
  std::optional<map::RobotFile> robot_file;
  if (!scenario.robot_file.empty()) robot_file = map::load_robot_file(scenario.robot_file);
  Robot robot{.file = file,
              .robot_file = scenario.robot_file.string(),
              .map = scenario.map_file.string(),
              .settings = settings_of(scenario)};
  robot.body = body_of(scenario.robot, robot_file, robot.settings);
  if (robot_file) robot.zones = robot_file->zones;
  return robot;
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
  return fmt::format("{} of {} corners, x {}, y {}, z {}", sim::box_of(body) ? "box" : "brush",
                     body.vertices.size(), range_text(box.min().x(), box.max().x()),
                     range_text(box.min().y(), box.max().y()), heights);
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

std::string text_of(const Robot& robot) {
  std::string text = path_text(robot.file) + "\n";
  const auto row = [&](const std::string& name, const std::string& value, const std::string& origin) {
    text += fmt::format("  {:<32} {:<52} {}", name, value, origin);
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n";
  };
  if (!robot.map.empty() && !robot.robot_file.empty()) row("robot file", path_text(robot.robot_file), "");
  if (robot.body) row("body", body_text(robot.body->shape), robot.body->origin);
  if (!robot.body) row("body", "a point", "default");
  for (const map::BumpZone& zone : robot.zones)
    row("zone " + zone.name, zone_text(zone), robot_file_line(zone.line));
  std::string table;
  for (const RobotSetting& setting : robot.settings) {
    if (setting.table != table) text += "[" + setting.table + "]\n";
    table = setting.table;
    const std::string_view unit = unit_of(setting.key);
    row(printable(setting.key, 60),
        printable(setting.value, 60) + (unit.empty() ? "" : " " + std::string(unit)), setting.origin);
  }
  return text;
}

// ---- JSON -----------------------------------------------------------------------------------------------------------

Json json_of(const Body& body) {
  Json corners = Json::array();
  for (const Vec3& corner : body.shape.vertices) corners.push_back(place_json(corner));
  return {{"line", body.shape.line},
          {"radius_m", body.shape.is_cylinder() ? Json(body.shape.radius_m) : Json(nullptr)},
          {"bottom_m", body.shape.bottom_m},
          {"top_m", body.shape.top_m},
          {"corners_m", corners},
          {"origin", body.origin}};
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

Json name_json(const std::string& file) {
  return file.empty() ? Json(nullptr) : Json(path_text(file));
}

Json document_of(const Robot& robot) {
  Json zones = Json::array(), settings = Json::array();
  for (const map::BumpZone& zone : robot.zones) zones.push_back(json_of(zone));
  for (const RobotSetting& setting : robot.settings) {
    settings.push_back({{"table", setting.table},
                        {"key", setting.key},
                        {"value", printable(setting.value)},
                        {"unit", std::string(unit_of(setting.key))},
                        {"origin", setting.origin}});
  }
  return {{"schema", "hallway.robot/1"},
          {"status", 0},
          {"file", path_text(robot.file)},
          {"robot_file", name_json(robot.robot_file)},
          {"map", name_json(robot.map)},
          {"body", robot.body ? json_of(*robot.body) : Json(nullptr)},
          {"zones", zones},
          {"settings", settings}};
}

struct RobotOptions {
  std::string file;
  std::vector<std::string> settings;
  bool json = false;
};

int show_robot(const RobotOptions& options) {
  const bool is_scenario = fs::path(options.file).extension() == ".toml";
  if (!is_scenario && !options.settings.empty()) refuse("--set belongs to a scenario, not to a robot file");
  const Robot robot =
      is_scenario ? robot_of(options.file, scenario_overrides(options.settings, std::nullopt, std::nullopt))
                  : robot_of(options.file);
  if (options.json) {
    print_json(document_of(robot));
  } else {
    print_result(text_of(robot));
  }
  return 0;
}

}  // namespace

void add_robot_command(Command& app) {
  Command& command = app.command(
      "robot", "Print what a robot file or a scenario says of its robot, and where each value comes from");
  RobotOptions& options = command.runs(&show_robot);
  command
      .argument("file", &options.file,
                "A robot file, which is a .map with _hallway_robot 1, or a scenario (.toml)")
      .required()
      .value("FILE|SCENARIO");
  add_shared(command, Shared::kSet, &options.settings).repeatable();
  add_shared(command, Shared::kJson, &options.json);
  command.footer(
      "Example: hallway robot maps/robots/cart.map\n"
      "Example: hallway robot maps/office_cart.toml --set sensor.eyes.max_range_m=5");
}

}  // namespace hallway::cli
