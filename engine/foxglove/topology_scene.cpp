// SPDX-License-Identifier: MIT
#include "foxglove/topology_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <utility>

#include "base/text.hpp"

namespace hallway::foxglove {
namespace {

constexpr double kRadius_m = 0.12;
constexpr double kShortestArrow_m = 0.1;
constexpr double kLongestArrow_m = 1.0;
constexpr double kText_px = 12.0;
constexpr int kCircleCorners = 24;
constexpr Colour kEdgeColour{0.149, 0.169, 0.2};

/// In the order of log::PlaceKind; as those of pictures.
constexpr std::array<Colour, 5> kPlaceColours{{{0.835, 0.369, 0.0},
                                               {0.44, 0.463, 0.502},
                                               {0.835, 0.369, 0.0},
                                               {0.416, 0.318, 0.639},
                                               {0.416, 0.318, 0.639}}};

/// In the order of log::DrawingColour; as those of pictures.
constexpr std::array<Colour, 8> kDrawingColours{{{0.149, 0.169, 0.2},
                                                 {0.6, 0.6, 0.6},
                                                 {0.0, 0.533, 0.412},
                                                 {0.835, 0.369, 0.0},
                                                 {0.0, 0.408, 0.659},
                                                 {0.8, 0.475, 0.655},
                                                 {0.667, 0.133, 0.353},
                                                 {0.902, 0.624, 0.0}}};

/// A regular polygon, closed.
Line ring(const Vec3& middle, double radius_m, int corners, double from_rad, const Colour& colour) {
  Line line{.width_px = 2.0, .colour = colour};
  for (int i = 0; i <= corners; ++i) {
    const double angle = from_rad + 2.0 * std::numbers::pi * (i % corners) / corners;
    line.points.emplace_back(middle + radius_m * Vec3(std::cos(angle), std::sin(angle), 0.0));
  }
  return line;
}

Line arrow(const log::TopologyNode& node, const SeenPlace& seen, const Colour& colour) {
  const Vec3 way =
      std::clamp(node.size_m.value_or(0.0), kShortestArrow_m, kLongestArrow_m) * step_way(node, seen);
  const Vec3 from = seen.place + kRadius_m * way.normalized(), tip = from + way;
  Line line{.kind = Line::Kind::kPairs, .points = {from, tip}, .width_px = 2.0, .colour = colour};
  for (const double angle : {0.45, -0.45}) {
    const Vec3 back = Eigen::AngleAxisd(angle, Vec3::UnitZ()) * -way.normalized();
    line.points.insert(line.points.end(), {tip, tip + 0.5 * kRadius_m * back});
  }
  return line;
}

void add_node(const log::TopologyNode& node, const SeenPlace& seen, Entity& entity) {
  const Colour& colour = kPlaceColours.at(static_cast<std::size_t>(node.kind));
  if (node.kind == log::PlaceKind::kDiscontinuity) {
    entity.lines.push_back(ring(seen.place, kRadius_m, kCircleCorners, 0.0, colour));
    entity.lines.push_back(arrow(node, seen, colour));
  } else {
    constexpr double kQuarter = std::numbers::pi / 4.0, kUp = std::numbers::pi / 2.0;
    const bool has_triangle = node.kind == log::PlaceKind::kRoom || node.kind == log::PlaceKind::kJunction;
    entity.lines.push_back(ring(seen.place, 1.4 * kRadius_m, 4, kQuarter, colour));
    entity.lines.push_back(ring(seen.place, 0.6 * kRadius_m, has_triangle ? 3 : kCircleCorners,
                                has_triangle ? kUp : 0.0, colour));
  }
  entity.texts.push_back({.place = seen.place + Vec3(0.0, 0.0, 0.1),
                          .text = std::to_string(node.id),
                          .size_px = kText_px,
                          .colour = colour});
}

Vec3 on_ground(const std::array<double, 2>& point) {
  return {point[0], point[1], 0.0};
}

}  // namespace

Entity topology_graph(const std::string& frame, const log::Topology& topology,
                      std::span<const std::optional<SeenPlace>> places) {
  Entity entity{.frame = frame, .id = "topology"};
  std::unordered_map<std::uint32_t, Vec3> known;
  for (std::size_t i = 0; i < topology.nodes.size(); ++i) {
    if (places[i]) known[topology.nodes[i].id] = places[i]->place;
  }
  Line edges{.kind = Line::Kind::kPairs, .width_px = 1.5, .colour = kEdgeColour};
  for (const log::TopologyEdge& edge : topology.edges) {
    const auto from = known.find(edge.from), to = known.find(edge.to);
    if (from == known.end() || to == known.end()) continue;
    edges.points.insert(edges.points.end(), {from->second, to->second});
  }
  if (!edges.points.empty()) entity.lines.push_back(std::move(edges));
  for (std::size_t i = 0; i < topology.nodes.size(); ++i) {
    if (places[i]) add_node(topology.nodes[i], *places[i], entity);
  }
  return entity;
}

Entity drawing_scene(const std::string& frame, const log::Drawing& drawing) {
  Entity entity{.frame = frame, .id = "drawing"};
  for (const log::DrawingItem& item : drawing) {
    const Colour& colour = kDrawingColours.at(static_cast<std::size_t>(item.colour));
    switch (item.kind) {
      case log::DrawingKind::kPolyline: {
        Line line{.width_px = 2.0, .colour = colour};
        for (const auto& point : item.points_m) line.points.push_back(on_ground(point));
        if (item.closed) line.points.push_back(on_ground(item.points_m.front()));
        entity.lines.push_back(std::move(line));
        break;
      }
      case log::DrawingKind::kCircle:
        entity.lines.push_back(
            ring(on_ground(item.points_m.front()), item.radius_m, kCircleCorners, 0.0, colour));
        break;
      case log::DrawingKind::kText:
        entity.texts.push_back({.place = on_ground(item.points_m.front()),
                                .text = printable(item.text),
                                .size_px = kText_px,
                                .colour = colour});
        break;
    }
  }
  return entity;
}

}  // namespace hallway::foxglove
