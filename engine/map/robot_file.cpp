// SPDX-License-Identifier: MIT
#include "map/robot_file.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/text.hpp"
#include "map/entity_keys.hpp"
#include "map/reader.hpp"
#include "map/sensors.hpp"

namespace hallway::map {
namespace {

constexpr std::array<std::string_view, 6> kRobotKeys{"step_m",      "ledge_m", "slope_deg",
                                                     "clearance_m", "ledges",  "contact"};
constexpr std::array<std::string_view, 8> kWorldClasses{
    "hw_add",  "hw_subtract", "hw_detail",         "hw_robot_start",
    "hw_path", "hw_waypoint", "hw_landmark_cloud", "hw_mesh"};

/// Keys that the entity has and its class lists, in the order of the file.
std::vector<RobotKey> known_keys(const Entity& entity) {
  const EntitySpec* spec = find_entity_spec(entity.classname());
  std::vector<RobotKey> keys;
  for (const KeyValue& pair : entity.keys) {
    if (spec->key(pair.key)) keys.push_back({pair.key, pair.value, pair.line});
  }
  return keys;
}

void check_keys_of(const EntityKeys& keys, std::string_view classname) {
  keys.refuse_unknown();
  for (const KeySpec& key : find_entity_spec(classname)->keys) {
    if (key.required || keys.has(key.name)) keys.check_value(key);
  }
}

void read_drive(const Document& document, RobotFile& robot) {
  const Entity* first = nullptr;
  for (const Entity& entity : document.entities) {
    if (entity.classname() != "hw_drive") continue;
    const EntityKeys keys(document, entity);
    if (first) throw keys.error("a second `hw_drive`; the first is at line " + std::to_string(first->line));
    first = &entity;
    robot.has_drive = true;
    robot.drive_line = entity.line;
    check_keys_of(keys, "hw_drive");
    for (RobotKey& key : known_keys(entity)) {
      (is_key_of_robot(key.key) ? robot.robot : robot.drive).push_back(std::move(key));
    }
  }
}

std::string metres_text(const Vec3& place) {
  return format_double(place.x()) + " " + format_double(place.y()) + " " + format_double(place.z());
}

/// The mount of a sensor that has one: `origin`, or `position_m` where there is no origin.
RobotSensor read_sensor(const Document& document, const Entity& entity) {
  const EntityKeys keys(document, entity);
  RobotSensor sensor{keys.text("name"), known_keys(entity), entity.line};
  std::erase_if(sensor.keys, [](const RobotKey& key) { return key.key == "name"; });
  const EntitySpec& spec = *find_entity_spec("hw_sensor");
  const bool has_mount = spec.key("position_m", variant_of(spec, entity)) != nullptr;
  if (!keys.has("origin") || !has_mount) return sensor;
  const Vec3 mount_m = keys.origin_m();
  if (keys.has("position_m")) {
    constexpr double kSame_m = 1e-6;
    if ((keys.vector("position_m") - mount_m).norm() > kSame_m)
      throw keys.error("`position_m` is not where `origin` is: in a robot file the origin is the mount",
                       "position_m");
    return sensor;
  }
  const auto origin = std::ranges::find(entity.keys, "origin", &KeyValue::key);
  sensor.keys.push_back({"position_m", metres_text(mount_m), origin->line});
  return sensor;
}

}  // namespace

bool is_key_of_robot(std::string_view key) {
  return std::ranges::find(kRobotKeys, key) != kRobotKeys.end();
}

bool is_robot_file(const Document& document) {
  const Entity* world = document.worldspawn();
  return world && world->has("_hallway_robot", "1");
}

void require_world(const Document& document) {
  if (!is_robot_file(document)) return;
  const auto& keys = document.worldspawn()->keys;
  const auto found = std::ranges::find(keys, "_hallway_robot", &KeyValue::key);
  throw Error(ErrorCode::kBadInput, "this is a robot file and no map: it has `_hallway_robot 1`",
              {document.file, found->line, {}});
}

RobotFile read_robot(const Document& document) {
  if (!is_robot_file(document)) {
    throw Error(ErrorCode::kBadInput, "the map is no robot file: its worldspawn has no `_hallway_robot 1`",
                {document.file, 0, {}});
  }
  for (const Entity& entity : document.entities) {
    const EntityKeys keys(document, entity);
    if (std::ranges::find(kWorldClasses, entity.classname()) != kWorldClasses.end())
      throw keys.error("a robot file has no `" + std::string(entity.classname()) + "`", "classname");
  }
  RobotFile robot;
  robot.file = document.file;
  robot.body = robot_body(document);
  robot.zones = bump_zones(document, robot.body);
  read_drive(document, robot);
  for (const Entity* sensor : sensors(document)) robot.sensors.push_back(read_sensor(document, *sensor));
  return robot;
}

RobotFile load_robot_file(const std::filesystem::path& file) {
  return read_robot(load(file));
}

}  // namespace hallway::map
