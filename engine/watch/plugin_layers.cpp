// SPDX-License-Identifier: MIT
#include "watch/plugin_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <unordered_map>

#include "base/text.hpp"

namespace hallway::watch {
namespace {

/// In the order of log::PlaceKind. Figure 25 of the thesis has circles for steps of the wall, triangles for rooms, squares for hallways.
constexpr std::u32string_view kPlaces = U"○◎△□◇";
constexpr std::u32string_view kAsciiPlaces = U"DSREJ";

/// Limits of the line of a step [m]; those of Foxglove's arrows.
constexpr double kShortestStep_m = 0.1;
constexpr double kLongestStep_m = 1.0;
constexpr std::size_t kMostText = 60;
constexpr int kCircleSides = 32;

/// In the order of log::DrawingColour: a terminal has eight colours.
constexpr std::array<Role, 8> kDrawingRoles{Role::kText,  Role::kDim,      Role::kSeen,    Role::kDrawn,
                                            Role::kDrawn, Role::kLandmark, Role::kContact, Role::kDrawn};

using Places = std::unordered_map<std::uint32_t, foxglove::SeenPlace>;

void draw_edges(const log::Topology& topology, const Places& places, const Drawing& drawing) {
  for (const log::TopologyEdge& edge : topology.edges) {
    const auto from = places.find(edge.from), to = places.find(edge.to);
    if (from == places.end() || to == places.end()) continue;
    drawing.line({from->second.place.head<2>(), to->second.place.head<2>()}, Role::kMapped);
  }
}

void draw_step(const log::TopologyNode& node, const foxglove::SeenPlace& seen, const Drawing& drawing) {
  const double length_m = std::clamp(node.size_m.value_or(0.0), kShortestStep_m, kLongestStep_m);
  const Vec3 tip = seen.place + length_m * foxglove::step_way(node, seen);
  drawing.line({seen.place.head<2>(), tip.head<2>()}, Role::kEstimate);
}

Vec2 in_world(const Pose& T_world_body, double x_m, double y_m) {
  return (T_world_body * Vec3(x_m, y_m, 0.0)).head<2>();
}

void draw_polyline(const log::DrawingItem& item, const Pose& pose, Role role, const Drawing& drawing) {
  const std::size_t n = item.points_m.size();
  for (std::size_t i = item.closed ? 0 : 1; i < n; ++i) {
    const auto& [from_x, from_y] = item.points_m[(i + n - 1) % n];
    const auto& [to_x, to_y] = item.points_m[i];
    drawing.line({in_world(pose, from_x, from_y), in_world(pose, to_x, to_y)}, role);
  }
}

void draw_circle(const log::DrawingItem& item, const Pose& pose, Role role, const Drawing& drawing) {
  const Vec2 middle(item.points_m.front()[0], item.points_m.front()[1]);
  const auto corner = [&](int i) {
    const double angle = 2.0 * std::numbers::pi * i / kCircleSides;
    return in_world(pose, middle.x() + item.radius_m * std::cos(angle),
                    middle.y() + item.radius_m * std::sin(angle));
  };
  for (int i = 0; i < kCircleSides; ++i) drawing.line({corner(i), corner(i + 1)}, role);
}

/// Right of the robot where it would lie under the robot.
void draw_text(const log::DrawingItem& item, const Pose& pose, Role role, const Drawing& drawing) {
  const std::string text = printable(item.text);
  const double columns = shape_of(drawing.dots).columns, rows = shape_of(drawing.dots).rows;
  const auto cell_of = [&](const Vec2& place) {
    const Vec2 dots = drawing.at(place);
    return Vec2(std::floor(dots.x() / columns), std::floor(dots.y() / rows));
  };
  const Vec2 robot = cell_of(pose.t.head<2>());
  Vec2 cell = cell_of(in_world(pose, item.points_m.front()[0], item.points_m.front()[1]));
  const auto length = static_cast<double>(glyphs_of(text).size());
  const bool is_covered = cell.y() == robot.y() && cell.x() <= robot.x() && robot.x() < cell.x() + length;
  if (is_covered) cell.x() = robot.x() + 1.0;
  drawing.text((cell + Vec2(0.5, 0.5)).cwiseProduct(Vec2(columns, rows)), text, role);
}

}  // namespace

char32_t glyph_of(log::PlaceKind kind, Dots dots) {
  return (dots == Dots::kAscii ? kAsciiPlaces : kPlaces)[static_cast<std::size_t>(kind)];
}

std::string topology_text(const log::Topology& topology) {
  const std::size_t n = topology.nodes.size();
  return fmt::format("{} node{}, loop {}", n, n == 1 ? "" : "s", log::loop_state_name(topology.loop));
}

std::string drawn_text(const log::Drawing& drawing) {
  std::string all;
  for (const log::DrawingItem& item : drawing) {
    if (item.kind != log::DrawingKind::kText || all.size() > kMostText) continue;
    all += (all.empty() ? "" : ", ") + printable(item.text, kMostText);
  }
  return printable(all, kMostText);
}

void draw_topology(const Subject& subject, const Drawing& drawing) {
  if (!subject.moment.topology) return;
  const log::Topology& topology = *subject.moment.topology;
  Places places;
  for (const log::TopologyNode& node : topology.nodes) {
    if (const auto seen = subject.past.place_of(node)) places[node.id] = *seen;
  }
  draw_edges(topology, places, drawing);
  // Steps are many: in a cell of both, the other place is the one to see.
  for (const bool of_steps : {true, false}) {
    for (const log::TopologyNode& node : topology.nodes) {
      const auto seen = places.find(node.id);
      const bool is_step = node.kind == log::PlaceKind::kDiscontinuity;
      if (seen == places.end() || is_step != of_steps) continue;
      if (is_step) draw_step(node, seen->second, drawing);
      drawing.glyph(seen->second.place.head<2>(), glyph_of(node.kind, drawing.dots), Role::kEstimate);
    }
  }
}

void draw_drawing(const Subject& subject, const Drawing& drawing) {
  const std::optional<Pose> pose = pose_shown(subject.moment, subject.past.place(subject.moment.iteration));
  if (!pose) return;
  for (const log::DrawingItem& item : subject.moment.drawing) {
    const Role role = kDrawingRoles[static_cast<std::size_t>(item.colour)];
    switch (item.kind) {
      case log::DrawingKind::kPolyline:
        draw_polyline(item, *pose, role, drawing);
        break;
      case log::DrawingKind::kCircle:
        draw_circle(item, *pose, role, drawing);
        break;
      case log::DrawingKind::kText:
        draw_text(item, *pose, role, drawing);
        break;
    }
  }
}

}  // namespace hallway::watch
