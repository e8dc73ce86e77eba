// SPDX-License-Identifier: MIT
#include "map/start_check.hpp"

#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/text.hpp"
#include "map/check.hpp"
#include "map/entity_keys.hpp"
#include "map/path.hpp"

namespace hallway::map {
namespace {

/// Some maps have the start on the floor and the path at the height of the sensors.
bool is_same_place(const Vec3& a, const Vec3& b) {
  constexpr double kNear_m = 0.01;
  constexpr double kSameFloor_m = 1.0;
  return (a - b).head<2>().norm() <= kNear_m && std::abs(a.z() - b.z()) <= kSameFloor_m;
}

/// The waypoint of a path with the lowest index; none for a path of another shape.
std::optional<Vec3> first_waypoint(const Document& document, std::string_view path) {
  std::optional<Vec3> first;
  std::int64_t lowest = std::numeric_limits<std::int64_t>::max();
  for (const Entity& entity : document.entities) {
    if (entity.classname() != "hw_waypoint") continue;
    const EntityKeys keys(document, entity);
    if (keys.text("path") != path || keys.integer("index") >= lowest) continue;
    lowest = keys.integer("index");
    first = keys.origin_m();
  }
  return first;
}

std::optional<StartOffPath> compare(const Document& document, const RobotStart& start,
                                    std::string_view name) {
  const Path path = find_path(document, name);
  const Vec3& at = start.T_world_body.t;
  StartOffPath found{start, std::string(name), path.at(0.0), 0.0};
  found.distance_m = (found.T_world_begin.t - at).norm();
  if (is_same_place(found.T_world_begin.t, at)) return std::nullopt;
  if (path.closed()) {
    const auto corner = first_waypoint(document, name);
    if (corner && is_same_place(*corner, at)) return std::nullopt;
  }
  return found;
}

/// To a tenth of a millimetre.
std::string number_text(double metres) {
  return format_double(std::round(metres * 1e4) / 1e4 + 0.0);
}

std::string place_text(const Vec3& place) {
  return "(" + number_text(place.x()) + ", " + number_text(place.y()) + ", " + number_text(place.z()) + ")";
}

}  // namespace

std::optional<StartOffPath> start_off_path(const Document& document, std::string_view path) {
  const auto start = default_robot_start(document);
  return start ? compare(document, *start, path) : std::nullopt;
}

std::optional<StartOffPath> start_off_all_paths(const Document& document) {
  std::optional<StartOffPath> nearest;
  try {
    const auto start = default_robot_start(document);
    if (!start) return std::nullopt;
    std::size_t tried = 0;
    for (const Entity& entity : document.entities) {
      const std::string* name = entity.find("name");
      if (entity.classname() != "hw_path" || name == nullptr) continue;
      if (++tried > kMostPathsChecked) break;
      auto found = compare(document, *start, *name);
      if (!found) return std::nullopt;
      if (!nearest || found->distance_m < nearest->distance_m) nearest = std::move(found);
    }
  } catch (const Error&) {
    return std::nullopt;  // a start or path that cannot be read is a finding of its own
  }
  return nearest;
}

std::string start_off_path_text(const StartOffPath& found) {
  return "the robot start is at " + place_text(found.start.T_world_body.t) + ", but path `" +
         printable(found.path, 60) + "` begins at " + place_text(found.T_world_begin.t) + ", " +
         number_text(found.distance_m) +
         " m away: a robot on the path begins there, and the start has no effect";
}

}  // namespace hallway::map
