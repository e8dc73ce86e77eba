// SPDX-License-Identifier: MIT
#include "run/pictures/robot_things.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "base/text.hpp"
#include "drive/spec.hpp"
#include "geom/box.hpp"
#include "map/entity_schema.hpp"
#include "render/colour.hpp"
#include "run/pictures/sensor_outline.hpp"
#include "sim/robot_defaults.hpp"

namespace hallway::run {
namespace {

constexpr render::Rgb kBodyColour{206, 205, 200};
constexpr render::Rgb kWheelColour{60, 64, 72};
constexpr render::Rgb kAheadColour{170, 34, 90};
constexpr double kTurn = 2.0 * std::numbers::pi;

Vec3 on_circle(double radius, double angle, double z) {
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// The sides of a body; of a cylinder those of a prism.
std::vector<Polygon> sides_of(const map::RobotBody& body) {
  std::vector<Polygon> sides;
  for (std::size_t i = 0; i < body.sides.size(); ++i) {
    Polygon& side = sides.emplace_back(Polygon{{}, body.planes[i]});
    for (const std::uint32_t corner : body.sides[i]) side.vertices.push_back(body.vertices[corner]);
  }
  if (!body.is_cylinder()) return sides;
  constexpr int kSides = 72;
  Polygon top{{}, {Vec3::UnitZ(), body.top_m}}, bottom{{}, {-Vec3::UnitZ(), -body.bottom_m}};
  for (int i = 0; i < kSides; ++i) {
    const double a = kTurn * i / kSides, b = kTurn * (i + 1) / kSides, r = body.radius_m;
    top.vertices.push_back(on_circle(r, a, body.top_m));
    bottom.vertices.push_back(on_circle(r, -a, body.bottom_m));
    const Vec3 out = on_circle(1.0, (a + b) / 2.0, 0.0);
    sides.push_back({{on_circle(r, a, body.bottom_m), on_circle(r, b, body.bottom_m),
                      on_circle(r, b, body.top_m), on_circle(r, a, body.top_m)},
                     {out, out.dot(on_circle(r, a, 0.0))}});
  }
  sides.push_back(std::move(top));
  sides.push_back(std::move(bottom));
  return sides;
}

std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const Plane& plane) {
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = plane.distance(a), db = plane.distance(b);
    if (da <= 0.0) kept.push_back(a);
    if (da * db < 0.0) kept.push_back(a + (da / (da - db)) * (b - a));
  }
  return kept;
}

/// The convex pieces of space that a zone is: its region, or quarter turns of its sector.
std::vector<std::vector<Plane>> pieces_of(const map::BumpZone& zone) {
  if (!zone.region.empty()) return {zone.region};
  std::vector<std::vector<Plane>> pieces;
  for (double from = zone.from_rad; from < zone.to_rad; from += kTurn / 4.0) {
    const double to = std::min(from + kTurn / 4.0, zone.to_rad);
    pieces.push_back({{Vec3(std::sin(from), -std::cos(from), 0.0), 0.0},
                      {Vec3(-std::sin(to), std::cos(to), 0.0), 0.0},
                      {Vec3::UnitZ(), zone.top_m},
                      {-Vec3::UnitZ(), -zone.bottom_m}});
  }
  return pieces;
}

/// Upright sides alone, unless the zone has none of them: so that zones beside each other can be told apart from above.
std::vector<std::vector<Vec3>> areas_of(const map::BumpZone& zone, const std::vector<Polygon>& sides) {
  constexpr double kLift_m = 5e-4, kUpright = 0.7;
  std::vector<std::vector<Vec3>> upright, others;
  for (const std::vector<Plane>& piece : pieces_of(zone)) {
    for (const Polygon& side : sides) {
      std::vector<Vec3> area = side.vertices;
      for (const Plane& plane : piece) area = clipped(area, plane);
      if (area.size() < 3) continue;
      for (Vec3& corner : area) corner += kLift_m * side.plane.normal;
      (std::abs(side.plane.normal.z()) < kUpright ? upright : others).push_back(std::move(area));
    }
  }
  return upright.empty() ? others : upright;
}

void add_zone(render::Picture& picture, const map::BumpZone& zone, const std::vector<Polygon>& sides,
              double size_m) {
  const render::Rgb colour = render::submap_colour(picture.patches.size());
  render::Patches patches{
      .polygons = areas_of(zone, sides), .colour = colour, .opacity = 0.75, .outline_px = 0.0};
  patches.label = "zone " + printable(zone.name, 80);
  render::Segments rim{.colour = colour, .width_px = 5.0};
  Vec3 middle = Vec3::Zero();
  std::size_t n = 0;
  for (const std::vector<Vec3>& area : patches.polygons) {
    for (std::size_t i = 0; i < area.size(); ++i) {
      const Vec3 &a = area[i], &b = area[(i + 1) % area.size()];
      if (std::abs((a - b).z()) < 1e-6) rim.pairs.push_back({a, b});
      middle += a;
      ++n;
    }
  }
  if (n == 0) return;
  middle /= static_cast<double>(n);
  if (const double out = middle.head<2>().norm(); out > 1e-6) middle.head<2>() *= 1.0 + 0.12 * size_m / out;
  picture.labels.push_back({.position = middle, .text = printable(zone.name, 80)});
  picture.segments.push_back(std::move(rim));
  picture.patches.push_back(std::move(patches));
}

/// A wheel that rolls along x, or a track with wheels at its ends.
void add_wheel(render::Segments& lines, const Vec3& back, const Vec3& front, double radius_m) {
  constexpr int kPieces = 24;
  const double half_width = 0.3 * radius_m;
  for (const double side : {-half_width, half_width}) {
    std::vector<Vec3> rim;
    for (int i = 0; i < kPieces; ++i) {
      const double angle = kTurn * (i + 0.5) / kPieces;
      rim.push_back((std::cos(angle) > 0.0 ? front : back) +
                    radius_m * Vec3(std::cos(angle), 0.0, std::sin(angle)) + Vec3(0.0, side, 0.0));
    }
    for (std::size_t i = 0; i < rim.size(); ++i) {
      lines.pairs.push_back({rim[i], rim[(i + 1) % rim.size()]});
      if (side < 0.0) lines.pairs.push_back({rim[i], rim[i] + Vec3(0.0, 2.0 * half_width, 0.0)});
    }
  }
}

double number_of(const map::RobotFile& robot, std::string_view key) {
  for (const std::vector<map::RobotKey>* keys : {&robot.drive, &robot.robot}) {
    const auto found = std::ranges::find(*keys, key, &map::RobotKey::key);
    if (found != keys->end()) return parse_double(trim(found->value)).value_or(0.0);
  }
  return parse_double(map::entity_key("hw_drive", key).fallback).value_or(0.0);
}

void add_wheels(render::Picture& picture, const map::RobotFile& robot) {
  const auto found = std::ranges::find(robot.drive, "kind", &map::RobotKey::key);
  const std::string kind = found == robot.drive.end() ? "differential" : found->value;
  const double radius = number_of(robot, "wheel_radius_m"), side = number_of(robot, "wheel_base_m") / 2.0;
  const double axles = number_of(robot, "axle_distance_m");
  const double z = robot.body.bottom_m - number_of(robot, "clearance_m") + radius;
  render::Segments lines{.colour = kWheelColour, .width_px = 1.2};
  lines.label = kind == "tracked" ? "tracks" : "wheels (" + printable(kind, 40) + ")";
  for (const double y : {-side, side}) {
    const Vec3 middle(0.0, y, z), half(axles / 2.0, 0.0, 0.0);
    if (kind == "tracked") {
      add_wheel(lines, middle - half, middle + half, radius);
    } else if (kind == "omnidirectional") {
      add_wheel(lines, middle - half, middle - half, radius);
      add_wheel(lines, middle + half, middle + half, radius);
    } else {
      add_wheel(lines, middle, middle, radius);
      if (kind == "ackermann") add_wheel(lines, middle + 2.0 * half, middle + 2.0 * half, radius);
    }
  }
  picture.segments.push_back(std::move(lines));
}

void add_sensors(render::Picture& picture, const map::RobotFile& robot, double size_m) {
  for (const sim::SensorSpec& sensor : sim::sensors_of(robot)) {
    const auto field = field_of(sensor);
    if (!field) continue;
    std::ranges::move(outlines_of(*field, Pose(), size_m), std::back_inserter(picture.polylines));
    picture.markers.push_back({.positions = {field->T_body_sensor.t},
                               .shape = render::MarkerShape::kSquare,
                               .colour = render::palette::kSensor,
                               .size_px = 9.0});
    picture.labels.push_back({.position = field->T_body_sensor.t,
                              .text = printable(field->name, 80),
                              .colour = render::palette::kSensor});
  }
}

/// An arrow from the origin, at the body's top, beyond its front.
void add_heading(render::Picture& picture, const Box& box) {
  const double z = box.max().z() + 1e-3, length = box.sizes().x();
  const Vec3 from(0.0, 0.0, z), to(box.max().x() + 0.2 * length, 0.0, z);
  const double barb = 0.06 * length;
  picture.segments.push_back(
      {.pairs = {{from, to}, {to, to + Vec3(-barb, barb, 0)}, {to, to + Vec3(-barb, -barb, 0)}},
       .colour = kAheadColour,
       .width_px = 2.5,
       .label = "ahead"});
  picture.markers.push_back({.positions = {from},
                             .shape = render::MarkerShape::kCross,
                             .colour = kAheadColour,
                             .size_px = 11.0,
                             .label = "origin"});
}

}  // namespace

render::Picture compose_robot_picture(const map::RobotFile& robot, const MapThings& things) {
  render::Picture picture;
  const std::vector<Polygon> sides = sides_of(robot.body);
  Box box;
  for (const Polygon& side : sides) {
    picture.surfaces.push_back({.polygon = side, .colour = kBodyColour});
    for (const Vec3& corner : side.vertices) box.extend(corner);
  }
  picture.subtitle = fmt::format("robot file: body {:.4g} x {:.4g} m, z {:.4g} to {:.4g} m", box.sizes().x(),
                                 box.sizes().y(), robot.body.bottom_m, robot.body.top_m);
  const double size_m = box.sizes().head<2>().maxCoeff();
  for (const map::BumpZone& zone : robot.zones) add_zone(picture, zone, sides, size_m);
  if (robot.has_drive) add_wheels(picture, robot);
  if (things.sensors) add_sensors(picture, robot, size_m);
  if (things.start) add_heading(picture, box);
  return picture;
}

}  // namespace hallway::run
