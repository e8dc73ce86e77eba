// SPDX-License-Identifier: MIT
#include "run/pictures/map_things.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>

#include "base/error.hpp"
#include "base/text.hpp"
#include "map/entities.hpp"
#include "map/path.hpp"
#include "render/colour.hpp"
#include "run/pictures/sensor_outline.hpp"
#include "sim/sensors.hpp"

namespace hallway::run {
namespace {

constexpr render::Rgb kStartColour{170, 34, 90};
constexpr render::Rgb kLightColour{201, 140, 0};

/// What `read` gives, or an empty value where the map is wrong there.
template <typename Read>
auto unless_wrong(Read read) -> decltype(read()) {
  try {
    return read();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kBadInput) throw;
    return {};
  }
}

std::string name_of(const map::Entity& entity, const char* key) {
  const std::string* name = entity.find(key);
  return name != nullptr ? printable(*name, 80) : std::string();
}

/// The points of a path, 0.1 m apart where that is not too many.
std::vector<Vec3> points_of(const map::Path& path) {
  constexpr double kPieceLength_m = 0.1, kMostPoints = 20'000;
  const double length = path.length_m();
  const double pieces = std::clamp(std::ceil(length / kPieceLength_m), 1.0, kMostPoints);
  std::vector<Vec3> points;
  for (double i = 0; i <= pieces; ++i) points.push_back(path.at(length * i / pieces).t);
  return points;
}

void add_paths(render::Picture& picture, const map::Document& document) {
  for (const map::Entity& entity : document.entities) {
    if (entity.classname() != "hw_path") continue;
    const std::string* name = entity.find("name");
    if (name == nullptr) continue;
    const auto path = unless_wrong([&] { return std::optional<map::Path>(map::find_path(document, *name)); });
    if (!path) continue;
    picture.polylines.push_back({.points = points_of(*path),
                                 .colour = render::palette::kTruth,
                                 .width_px = 2.0,
                                 .dashed = true,
                                 .label = "path " + printable(*name, 80)});
  }
}

/// Where the robot begins: at its start, else at the first path's.
std::optional<Pose> first_pose(const map::Document& document) {
  if (const auto start = unless_wrong([&] { return map::default_robot_start(document); }))
    return start->T_world_body;
  for (const map::Entity& entity : document.entities) {
    const std::string* name = entity.classname() == "hw_path" ? entity.find("name") : nullptr;
    if (name != nullptr)
      return unless_wrong([&] { return std::optional<Pose>(map::find_path(document, *name).at(0.0)); });
  }
  return std::nullopt;
}

void add_starts(render::Picture& picture, const map::Document& document) {
  constexpr double kHeading_m = 0.7;
  for (const map::RobotStart& start : unless_wrong([&] { return map::robot_starts(document); })) {
    const Pose& T = start.T_world_body;
    picture.polylines.push_back(
        {.points = {T.t, T * Vec3(kHeading_m, 0, 0)}, .colour = kStartColour, .width_px = 3.0});
    picture.markers.push_back(
        {.positions = {T.t},
         .shape = render::MarkerShape::kDiamond,
         .colour = kStartColour,
         .size_px = 11.0,
         .label = start.name.empty() ? "robot start" : "robot start " + printable(start.name, 80)});
  }
}

void add_map_sensors(render::Picture& picture, const map::Document& document) {
  constexpr double kLongest_m = 2.0;
  const std::optional<Pose> T_world_body = first_pose(document);
  if (!T_world_body) return;
  const auto sensors = unless_wrong([&] {
    sim::Scenario scenario;
    sim::take_map_sensors(scenario, document);
    return scenario.sensors;
  });
  for (const sim::SensorSpec& sensor : sensors)
    if (const auto field = field_of(sensor))
      std::ranges::move(outlines_of(*field, *T_world_body, kLongest_m),
                        std::back_inserter(picture.polylines));
}

void add_lights(render::Picture& picture, const world::CompiledWorld& world) {
  render::Markers lights{
      .shape = render::MarkerShape::kRing, .colour = kLightColour, .size_px = 9.0, .label = "lights"};
  for (const map::Occupant& occupant : world.occupants) {
    if (occupant.classname.starts_with("light")) lights.positions.push_back(occupant.position_m);
  }
  if (!lights.positions.empty()) picture.markers.push_back(std::move(lights));
}

/// The inside of a room: what the cuts of its group take away.
std::optional<Vec3> middle_of(const map::Document& document, const world::CompiledWorld& world,
                              const std::string& group) {
  Box inside;
  for (const map::Solid& solid : world.brushes.solids) {
    if (solid.role != map::BrushRole::kSubtract) continue;
    const std::string* of = document.entities[static_cast<std::size_t>(solid.entity)].find("_tb_group");
    if (of != nullptr && *of == group) inside.extend(solid.box);
  }
  if (inside.isEmpty()) return std::nullopt;
  return inside.center();
}

void add_rooms(render::Picture& picture, const map::Document& document, const world::CompiledWorld& world) {
  for (const map::Entity& entity : document.entities) {
    const std::string *made = entity.find("_hw_made"), *group = entity.find("_tb_id");
    if (made == nullptr || group == nullptr || !made->starts_with("room ")) continue;
    const std::string name = name_of(entity, "_tb_name");
    const std::optional<Vec3> middle = middle_of(document, world, *group);
    if (!name.empty() && middle) picture.labels.push_back({.position = *middle, .text = name});
  }
}

}  // namespace

void add_map_things(render::Picture& picture, const map::Document& document,
                    const world::CompiledWorld& world, const MapThings& things) {
  if (things.rooms) add_rooms(picture, document, world);
  if (things.paths) add_paths(picture, document);
  if (things.sensors) add_map_sensors(picture, document);
  if (things.lights) add_lights(picture, world);
  if (things.start) add_starts(picture, document);
}

}  // namespace hallway::run
