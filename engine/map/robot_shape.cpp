// SPDX-License-Identifier: MIT
#include "map/robot_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <variant>

#include "base/text.hpp"
#include "geometry/convex2.hpp"
#include "map/brush_solid.hpp"
#include "map/convex_body.hpp"
#include "map/entity_keys.hpp"
#include "map/sensors.hpp"
#include "map/world.hpp"

namespace hallway::map {
namespace {

constexpr double kThinnest_m = 1e-3;
constexpr double kFarthestBody_m = 100.0;
constexpr double kOnBorder_m = 1e-6;
constexpr double kSmallest_m = 1e-7;  ///< what is thinner is no part of a body
constexpr std::size_t kMostZones = 64;

Error brush_error(const Document& document, const Brush& brush, std::string message) {
  return Error(ErrorCode::kBadInput, std::move(message), {document.file, brush.line, {}});
}

/// The corners of a solid, each once.
std::vector<Vec3> corners_of(const Solid& solid) {
  std::vector<Vec3> corners;
  for (const SolidFace& face : solid.faces) {
    for (const Vec3& corner : face.polygon.vertices) {
      if (std::find(corners.begin(), corners.end(), corner) == corners.end()) corners.push_back(corner);
    }
  }
  std::sort(corners.begin(), corners.end(), [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  });
  return corners;
}

double thickness_of(const Solid& solid, const std::vector<Vec3>& corners) {
  double least = 2.0 * kFarthestBody_m;
  for (const Plane& plane : solid.planes) {
    double farthest = 0.0;
    for (const Vec3& corner : corners) farthest = std::max(farthest, -plane.distance(corner));
    least = std::min(least, farthest);
  }
  return least;
}

RobotBody polyhedron(const Document& document, const Brush& brush) {
  const Solid solid = solid_of(document, brush, "the robot's body");
  RobotBody body;
  body.vertices = corners_of(solid);
  body.line = brush.line;
  for (const Vec3& corner : body.vertices) {
    if (corner.norm() > kFarthestBody_m)
      throw brush_error(document, brush, "the robot's body reaches farther than 100 m from its origin");
  }
  if (const double thickness_m = thickness_of(solid, body.vertices); thickness_m < kThinnest_m) {
    throw brush_error(document, brush,
                      "the robot's body is " + format_double(thickness_m) + " m thick; 0.001 m is the least");
  }
  for (const SolidFace& face : solid.faces) {
    std::vector<std::uint32_t> loop;
    for (const Vec3& corner : face.polygon.vertices) {
      const auto found = std::find(body.vertices.begin(), body.vertices.end(), corner);
      loop.push_back(static_cast<std::uint32_t>(found - body.vertices.begin()));
    }
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    body.sides.push_back(std::move(loop));
    body.planes.push_back(face.polygon.plane);
  }
  body.bottom_m = solid.box.min().z();
  body.top_m = solid.box.max().z();
  return body;
}

RobotBody cylinder(const EntityKeys& keys, int line) {
  RobotBody body;
  body.radius_m = keys.number("radius_m", kThinnest_m, kFarthestBody_m);
  body.bottom_m = keys.number("bottom_m", -kFarthestBody_m, kFarthestBody_m);
  body.top_m = keys.number("top_m", -kFarthestBody_m, kFarthestBody_m);
  body.line = line;
  if (body.top_m - body.bottom_m < kThinnest_m)
    throw keys.error("`top_m` " + format_double(body.top_m) + " must be at least 0.001 above `bottom_m` " +
                         format_double(body.bottom_m),
                     "top_m");
  return body;
}

/// Half-spaces around a body; of a cylinder those of a prism of 256 sides about it.
std::vector<Plane> planes_around(const RobotBody& body) {
  if (!body.is_cylinder()) return body.planes;
  constexpr int kSides = 256;
  std::vector<Plane> planes{{Vec3::UnitZ(), body.top_m}, {-Vec3::UnitZ(), -body.bottom_m}};
  for (int i = 0; i < kSides; ++i) {
    const double at = 2.0 * std::numbers::pi * i / kSides;
    planes.push_back({Vec3(std::cos(at), std::sin(at), 0.0), body.radius_m});
  }
  return planes;
}

bool meets(const RobotBody& body, const std::vector<Plane>& region) {
  std::vector<Plane> planes = planes_around(body);
  planes.insert(planes.end(), region.begin(), region.end());
  const auto common = intersect_half_spaces(planes, 4.0 * kFarthestBody_m, kSmallest_m);
  return !std::holds_alternative<ConvexFault>(common);
}

bool is_strictly_inside(const RobotBody& body, const Vec3& point) {
  if (body.is_cylinder())
    return point.head<2>().norm() < body.radius_m && point.z() > body.bottom_m && point.z() < body.top_m;
  return std::all_of(body.planes.begin(), body.planes.end(),
                     [&](const Plane& plane) { return plane.distance(point) < 0.0; });
}

/// Whether the sector between two angles has some of the body: quarter turn by quarter turn, since each is convex.
bool sector_meets(const RobotBody& body, const BumpZone& zone) {
  const double quarter = std::numbers::pi / 2.0;
  for (double from = zone.from_rad; from < zone.to_rad; from += quarter) {
    const double to = std::min(from + quarter, zone.to_rad);
    const std::vector<Plane> wedge{{Vec3(std::sin(from), -std::cos(from), 0.0), 0.0},
                                   {Vec3(-std::sin(to), std::cos(to), 0.0), 0.0},
                                   {Vec3::UnitZ(), zone.top_m},
                                   {-Vec3::UnitZ(), -zone.bottom_m}};
    if (meets(body, wedge)) return true;
  }
  return false;
}

void read_sector(const EntityKeys& keys, const RobotBody& body, BumpZone& zone) {
  constexpr double kTurn_deg = 360.0;
  const double from_deg = keys.number("from_deg", -kTurn_deg, kTurn_deg);
  const double to_deg = keys.number("to_deg", -kTurn_deg, kTurn_deg);
  if (to_deg <= from_deg || to_deg - from_deg > kTurn_deg) {
    throw keys.error("`to_deg` " + format_double(to_deg) + " must be above `from_deg` " +
                         format_double(from_deg) + ", by at most 360",
                     "to_deg");
  }
  zone.from_rad = from_deg * std::numbers::pi / 180.0;
  zone.to_rad = to_deg * std::numbers::pi / 180.0;
  zone.bottom_m = keys.number_or("bottom_m", body.bottom_m, -kFarthestBody_m, kFarthestBody_m);
  zone.top_m = keys.number_or("top_m", body.top_m, -kFarthestBody_m, kFarthestBody_m);
  if (zone.top_m <= zone.bottom_m) {
    throw keys.error(
        "`top_m` " + format_double(zone.top_m) + " must be above `bottom_m` " + format_double(zone.bottom_m),
        keys.has("top_m") ? "top_m" : "bottom_m");
  }
  if (!sector_meets(body, zone)) throw keys.error("the bump zone `" + zone.name + "` is not at the body");
}

void read_region(const Document& document, const Entity& entity, const RobotBody& body, BumpZone& zone) {
  const EntityKeys keys(document, entity);
  for (const char* key : {"from_deg", "to_deg", "bottom_m", "top_m"}) {
    if (keys.has(key)) throw keys.error("a bump zone with a brush has no `" + std::string(key) + "`", key);
  }
  if (entity.brushes.size() > 1) throw keys.error("a bump zone has one brush");
  const Solid solid = solid_of(document, entity.brushes.front(), "the bump zone's brush");
  zone.region = solid.planes;
  zone.bottom_m = solid.box.min().z();
  zone.top_m = solid.box.max().z();
  const std::vector<Vec3> corners = corners_of(solid);
  const bool buried = std::all_of(corners.begin(), corners.end(),
                                  [&](const Vec3& corner) { return is_strictly_inside(body, corner); });
  if (buried) {
    throw keys.error("the bump zone `" + zone.name +
                     "` is inside of the body and has no part of its surface");
  }
  if (!meets(body, zone.region)) throw keys.error("the bump zone `" + zone.name + "` is not at the body");
}

}  // namespace

bool BumpZone::contains(const Vec3& point_m) const {
  if (!region.empty()) {
    return std::all_of(region.begin(), region.end(),
                       [&](const Plane& plane) { return plane.distance(point_m) <= kOnBorder_m; });
  }
  if (point_m.z() < bottom_m - kOnBorder_m || point_m.z() > top_m + kOnBorder_m) return false;
  constexpr double kTurn = 2.0 * std::numbers::pi, kOnBorder_rad = 1e-9;
  double turn = std::fmod(std::atan2(point_m.y(), point_m.x()) - from_rad, kTurn);
  if (turn < -kOnBorder_rad) turn += kTurn;
  return turn <= to_rad - from_rad + kOnBorder_rad || turn >= kTurn - kOnBorder_rad;
}

RobotBody robot_body(const Document& document) {
  std::vector<RobotBody> bodies;
  const auto add = [&](RobotBody body) {
    if (!bodies.empty()) {
      throw Error(ErrorCode::kBadInput,
                  "a second body; the first is at line " + std::to_string(bodies.front().line) +
                      ": a robot has one convex brush or one cylinder",
                  {document.file, body.line, {}});
    }
    bodies.push_back(std::move(body));
  };
  for (const Entity& entity : document.entities) {
    const std::string_view name = entity.classname();
    const bool is_body = name == "hw_body";
    if (!is_body && name != "worldspawn" && name != "func_group") continue;
    const EntityKeys keys(document, entity);
    keys.refuse_unknown();
    if (is_body && entity.brushes.empty()) add(cylinder(keys, entity.line));
    for (const char* key : {"radius_m", "bottom_m", "top_m"}) {
      if (is_body && !entity.brushes.empty() && keys.has(key))
        throw keys.error("a body with a brush has no `" + std::string(key) + "`", key);
    }
    for (const Brush& brush : entity.brushes) add(polyhedron(document, brush));
  }
  if (!bodies.empty()) return std::move(bodies.front());
  const Entity* world = document.worldspawn();
  throw Error(
      ErrorCode::kBadInput,
      "the robot file has no body: it needs one brush, or an `hw_body` with `radius_m`, `bottom_m` and "
      "`top_m`",
      {document.file, world ? world->line : 0, {}});
}

double distance_beside(const RobotBody& body, const Vec3& point_m) {
  const Vec2 point = point_m.head<2>();
  if (body.is_cylinder()) return std::max(0.0, point.norm() - body.radius_m);
  std::vector<Vec2> corners;
  for (const Vec3& vertex : body.vertices) corners.emplace_back(vertex.head<2>());
  const Convex outline = convex_hull(std::move(corners));
  double beside = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], along = outline[(i + 1) % outline.size()] - a;
    if (cross(along, point - a) >= 0.0) continue;
    const double share = std::clamp(along.dot(point - a) / along.squaredNorm(), 0.0, 1.0);
    // Of the edges that a point is outside of, the nearest counts.
    const double distance = (point - a - share * along).norm();
    beside = beside == 0.0 ? distance : std::min(beside, distance);
  }
  return beside;
}

std::vector<BumpZone> bump_zones(const Document& document, const RobotBody& body) {
  std::vector<BumpZone> zones;
  std::set<std::string> names;
  for (const Entity& entity : document.entities) {
    if (entity.classname() != "hw_bump_zone") continue;
    const EntityKeys keys(document, entity);
    keys.refuse_unknown();
    BumpZone zone;
    zone.name = keys.text("name");
    zone.line = entity.line;
    if (!is_sensor_name(zone.name)) {
      throw keys.error("key `name`: `" + printable(zone.name, 60) +
                           "` is no zone's name: 1 to 64 of the characters a-z, A-Z, 0-9, _ and -",
                       "name");
    }
    if (!names.insert(zone.name).second)
      throw keys.error("a second bump zone named `" + zone.name + "`", "name");
    if (names.size() > kMostZones)
      throw keys.error("a bump zone too many: at most " + std::to_string(kMostZones) + " are allowed");
    if (entity.brushes.empty()) {
      read_sector(keys, body, zone);
    } else {
      read_region(document, entity, body, zone);
    }
    zones.push_back(std::move(zone));
  }
  return zones;
}

}  // namespace hallway::map
