// SPDX-License-Identifier: MIT
#include "map/path.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "map/entity_keys.hpp"
#include "map/polyline_corners.hpp"

namespace hallway::map {
namespace {

constexpr double kDefaultCornerRadius_m = 0.5;
constexpr double kMaxLength_m = 1e6;
constexpr double kMinLength_m = 1e-3;

struct Waypoint {
  std::int64_t index;
  Vec3 position;
  const Entity* entity;
};

std::vector<const Entity*> path_entities(const Document& document) {
  std::vector<const Entity*> paths;
  for (const Entity& entity : document.entities) {
    if (entity.classname() == "hw_path") paths.push_back(&entity);
  }
  return paths;
}

const Entity& path_entity(const Document& document, std::string_view name) {
  const std::vector<const Entity*> entities = path_entities(document);
  const std::vector<std::string> names = path_names(document);
  const auto first = std::find(names.begin(), names.end(), name);
  if (first == names.end()) {
    std::string message = "the map has no path `" + printable(name, 60) + "`" + suggestion(name, names);
    message += names.empty() ? "; it has no hw_path at all" : "; it has";
    constexpr std::size_t kMostListed = 20;
    for (std::size_t i = 0; i < std::min(names.size(), kMostListed); ++i)
      message += (i ? ", `" : " `") + printable(names[i], 60) + "`";
    if (names.size() > kMostListed) message += " and " + std::to_string(names.size() - kMostListed) + " more";
    throw Error(ErrorCode::kBadInput, message, {document.file, 0, {}});
  }
  const auto second = std::find(std::next(first), names.end(), name);
  if (second != names.end()) {
    const Entity& other = *entities[static_cast<std::size_t>(second - names.begin())];
    throw EntityKeys(document, other).error("a second path named `" + printable(name, 60) + "`", "name");
  }
  return *entities[static_cast<std::size_t>(first - names.begin())];
}

/// In the order of their keys `index`. Looks at all waypoints of the map, so that one with a misspelt path is not lost.
std::vector<Waypoint> waypoints_of(const Document& document, std::string_view name) {
  const std::vector<std::string> names = path_names(document);
  const std::set<std::string_view> known(names.begin(), names.end());
  std::vector<Waypoint> waypoints;
  for (const Entity& entity : document.entities) {
    if (entity.classname() != "hw_waypoint") continue;
    const EntityKeys keys(document, entity);
    keys.refuse_unknown();
    const std::string path = keys.text("path");
    if (!known.contains(path)) {
      throw keys.error("the map has no path `" + printable(path, 60) + "`" + suggestion(path, names), "path");
    }
    if (path == name) waypoints.push_back({keys.integer("index"), keys.origin_m(), &entity});
  }
  std::stable_sort(waypoints.begin(), waypoints.end(),
                   [](const Waypoint& a, const Waypoint& b) { return a.index < b.index; });
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    if (waypoints[i].index != waypoints[i - 1].index) continue;
    throw EntityKeys(document, *waypoints[i].entity)
        .error("a second waypoint " + std::to_string(waypoints[i].index) + " of path `" +
                   printable(name, 60) + "`; the first is at line " +
                   std::to_string(waypoints[i - 1].entity->line),
               "index");
  }
  return waypoints;
}

Path waypoint_path(const Document& document, const EntityKeys& keys, std::string_view name,
                   CornerShape corners) {
  keys.refuse_unknown();
  const bool closed = keys.flag_or("closed", false);
  const double radius = keys.number_or("corner_radius_m", kDefaultCornerRadius_m, kMinLength_m, kMaxLength_m);
  const std::vector<Waypoint> waypoints = waypoints_of(document, name);
  std::vector<Vec3> positions;
  for (const Waypoint& waypoint : waypoints) positions.push_back(waypoint.position);
  if (const auto fault = check_polyline(positions, closed, radius)) {
    if (fault->waypoint >= waypoints.size()) throw keys.error(fault->message);
    const Waypoint& at = waypoints[fault->waypoint];
    throw EntityKeys(document, *at.entity)
        .error("waypoint " + std::to_string(at.index) + " of path `" + printable(name, 60) +
               "`: " + fault->message);
  }
  if (corners == CornerShape::kSmooth) return Path(SmoothPolyline(positions, closed, radius));
  return Path(RoundedPolyline(positions, closed, radius));
}

Path lemniscate_path(const EntityKeys& keys) {
  keys.refuse_unknown();
  LemniscateSpec spec;
  spec.crossing = keys.origin_m();
  spec.heading = keys.angle();
  spec.length_m = keys.number("length_m", kMinLength_m, kMaxLength_m);
  spec.rise_m = keys.number_or("rise_m", 0.0, -spec.length_m / 4.0, spec.length_m / 4.0);
  return Path(Lemniscate(spec));
}

}  // namespace

double Path::length_m() const {
  return std::visit([](const auto& curve) { return curve.length_m(); }, curve_);
}

bool Path::closed() const {
  return std::visit([](const auto& curve) { return curve.closed(); }, curve_);
}

Pose Path::at(double distance_m) const {
  return std::visit([&](const auto& curve) { return curve.at(distance_m); }, curve_);
}

CurvePoint Path::point(double distance_m, CurveSide side) const {
  if (const auto* rounded = std::get_if<RoundedPolyline>(&curve_)) return rounded->point(distance_m, side);
  if (const auto* smooth = std::get_if<SmoothPolyline>(&curve_)) return smooth->point(distance_m);
  return std::get<Lemniscate>(curve_).point(distance_m);
}

std::vector<double> Path::jumps_in(double from_m, double to_m) const {
  std::vector<double> found;
  std::vector<double> jumps;
  if (const auto* rounded = std::get_if<RoundedPolyline>(&curve_)) jumps = rounded->jumps_m();
  if (const auto* smooth = std::get_if<SmoothPolyline>(&curve_)) jumps = smooth->jumps_m();
  if (jumps.empty()) return found;
  const double round = closed() ? std::floor(from_m / length_m()) : 0.0;
  for (double begin_m = round * length_m(); begin_m <= to_m; begin_m += length_m()) {
    for (const double jump_m : jumps) {
      const double at_m = begin_m + jump_m;
      if (at_m > from_m && at_m <= to_m && (found.empty() || found.back() < at_m)) found.push_back(at_m);
    }
    if (!closed()) break;
  }
  return found;
}

std::vector<std::string> path_names(const Document& document) {
  std::vector<std::string> names;
  for (const Entity& entity : document.entities) {
    if (entity.classname() == "hw_path") names.push_back(EntityKeys(document, entity).text("name"));
  }
  return names;
}

Path find_path(const Document& document, std::string_view name, CornerShape corners) {
  const EntityKeys keys(document, path_entity(document, name));
  const std::string shape = keys.has("shape") ? keys.text("shape") : "waypoints";
  if (shape == "waypoints") return waypoint_path(document, keys, name, corners);
  if (shape == "lemniscate") return lemniscate_path(keys);
  throw keys.error("unknown shape `" + printable(shape, 60) + "`" +
                       suggestion(shape, {"waypoints", "lemniscate"}) +
                       "; there are `waypoints` and `lemniscate`",
                   "shape");
}

}  // namespace hallway::map
