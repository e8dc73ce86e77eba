// SPDX-License-Identifier: MIT
#include "map/path_start.hpp"

#include <cmath>

#include "base/text.hpp"
#include "map/entities.hpp"
#include "map/entity_keys.hpp"
#include "map/path.hpp"

namespace hallway::map {
namespace {

std::string place_text(const Vec3& place) {
  const auto rounded = [](double value) { return format_double(std::round(value * 100.0) / 100.0 + 0.0); };
  return "(" + rounded(place.x()) + ", " + rounded(place.y()) + ", " + rounded(place.z()) + ")";
}

/// Some put the start on the floor and the path at the height of the sensors.
bool is_at(const Vec3& start, const Vec3& begin) {
  constexpr double kNear_m = 0.05;
  constexpr double kSameFloor_m = 1.0;
  const Vec3 apart = begin - start;
  return apart.head<2>().norm() <= kNear_m && std::abs(apart.z()) <= kSameFloor_m;
}

/// The place of the first waypoint, which is not on a closed path whose corners are rounded; empty for a path without waypoints.
std::optional<Vec3> first_waypoint(const Document& document, std::string_view path) {
  std::optional<Vec3> first;
  std::int64_t least = 0;
  for (const Entity& entity : document.entities) {
    if (entity.classname() != "hw_waypoint") continue;
    const EntityKeys keys(document, entity);
    if (keys.text("path") != path || (first && keys.integer("index") >= least)) continue;
    least = keys.integer("index");
    first = keys.origin_m();
  }
  return first;
}

}  // namespace

std::vector<std::string> path_names(const Document& document) {
  std::vector<std::string> names;
  for (const Entity& entity : document.entities) {
    if (entity.classname() == "hw_path") names.push_back(EntityKeys(document, entity).text("name"));
  }
  return names;
}

std::optional<Error> start_off_path(const Document& document, std::string_view path) {
  const std::optional<RobotStart> start = find_robot_start(document);
  if (!start) return std::nullopt;
  const Vec3 place = start->T_world_body.t;
  const Vec3 begin = find_path(document, path).at(0.0).t;
  const std::optional<Vec3> waypoint = first_waypoint(document, path);
  if (is_at(place, begin) || (waypoint && is_at(place, *waypoint))) return std::nullopt;
  const Entity& entity = document.entities[static_cast<std::size_t>(start->entity)];
  return EntityKeys(document, entity)
      .error("the robot start is at " + place_text(place) + ", and the path `" + printable(path, 60) +
             "` begins at " + place_text(waypoint.value_or(begin)) +
             ": a run on that path begins there, not at the robot start");
}

}  // namespace hallway::map
