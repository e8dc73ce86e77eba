// SPDX-License-Identifier: MIT
#include "log/topology_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.hpp"

namespace hallway::log {
namespace {

using Written = nlohmann::ordered_json;
using Json = nlohmann::json;

constexpr std::array<std::string_view, 5> kPlaceKinds{"discontinuity", "sweep", "room", "hallway_end",
                                                      "junction"};
constexpr std::array<std::string_view, 3> kLoopStates{"open", "closed", "uncertain"};
constexpr std::array<std::string_view, 3> kDrawingKinds{"polyline", "circle", "text"};
constexpr std::array<std::string_view, 8> kColours{"plain",   "faint",    "sensed",  "followed",
                                                   "planned", "landmark", "warning", "highlight"};

[[noreturn]] void refuse(const std::string& cause) {
  throw Error(ErrorCode::kBadInput, cause);
}

/// For writing.
double sound(double value) {
  if (!std::isfinite(value)) throw Error(ErrorCode::kInternal, "a number for a log is not finite");
  return value;
}

double finite_number(const Json& json, const char* member,
                     double least = -std::numeric_limits<double>::max()) {
  const double value = json.at(member).get<double>();
  if (!std::isfinite(value) || value < least) refuse(std::string(member) + " out of range");
  return value;
}

template <typename Whole>
Whole whole_number(const Json& json, const char* member) {
  const Json& value = json.at(member);
  if (!value.is_number_integer()) refuse(std::string(member) + " is no whole number");
  if (value.is_number_unsigned()) {
    if (std::cmp_greater(value.get<std::uint64_t>(), std::numeric_limits<Whole>::max()))
      refuse(std::string(member) + " out of range");
  } else if (std::cmp_less(value.get<std::int64_t>(), std::numeric_limits<Whole>::min())) {
    refuse(std::string(member) + " out of range");
  }
  return value.get<Whole>();
}

template <typename Enum, std::size_t N>
Enum choice(const Json& json, const char* member, const std::array<std::string_view, N>& names) {
  const auto found = std::ranges::find(names, json.at(member).get<std::string>());
  if (found == names.end()) refuse(std::string(member) + " is none that is known");
  return static_cast<Enum>(found - names.begin());
}

const Json& list_of(const Json& json, const char* member) {
  const Json& list = json.at(member);
  if (!list.is_array()) refuse(std::string(member) + " is no list");
  return list;
}

Written node_json(const TopologyNode& node) {
  Written json{{"id", node.id}, {"kind", place_kind_name(node.kind)}};
  if (node.kind == PlaceKind::kDiscontinuity) {
    json["direction"] = node.direction;
    json["size_m"] = nullptr;
    if (node.size_m && !std::isinf(*node.size_m)) json["size_m"] = sound(*node.size_m);
  }
  json["visits"] = node.visits;
  json["t_ns"] = node.t_ns;
  json["x_m"] = sound(node.x_m);
  json["y_m"] = sound(node.y_m);
  return json;
}

TopologyNode node_of(const Json& json) {
  TopologyNode node{.id = whole_number<std::uint32_t>(json, "id"),
                    .kind = choice<PlaceKind>(json, "kind", kPlaceKinds),
                    .visits = whole_number<std::uint32_t>(json, "visits"),
                    .t_ns = whole_number<std::int64_t>(json, "t_ns"),
                    .x_m = finite_number(json, "x_m"),
                    .y_m = finite_number(json, "y_m")};
  if (node.kind != PlaceKind::kDiscontinuity) return node;
  node.direction = whole_number<std::int32_t>(json, "direction");
  if (node.direction != 1 && node.direction != -1) refuse("a direction that is neither 1 nor -1");
  node.size_m = json.at("size_m").is_null() ? std::numeric_limits<double>::infinity()
                                            : finite_number(json, "size_m", 0.0);
  return node;
}

TopologyEdge edge_of(const Json& json) {
  TopologyEdge edge{.from = whole_number<std::uint32_t>(json, "from"),
                    .to = whole_number<std::uint32_t>(json, "to"),
                    .length_m = finite_number(json, "length_m", 0.0),
                    .confidence = finite_number(json, "confidence", 0.0),
                    .quarter_turns = whole_number<std::int32_t>(json, "quarter_turns")};
  if (edge.confidence > 1) refuse("confidence out of range");
  return edge;
}

DrawingItem item_of(const Json& json) {
  DrawingItem item{.kind = choice<DrawingKind>(json, "kind", kDrawingKinds),
                   .colour = choice<DrawingColour>(json, "colour", kColours),
                   .closed = json.value("closed", false)};
  for (const Json& point : list_of(json, "points_m")) {
    if (!point.is_array() || point.size() != 2) refuse("a point that has not two numbers");
    const std::array<double, 2> place{point[0].get<double>(), point[1].get<double>()};
    if (!std::isfinite(place[0]) || !std::isfinite(place[1])) refuse("a point that is not finite");
    item.points_m.push_back(place);
  }
  const bool is_line = item.kind == DrawingKind::kPolyline;
  if (is_line ? item.points_m.size() < 2 : item.points_m.size() != 1)
    refuse("a number of points that does not suit the kind");
  if (item.kind == DrawingKind::kCircle) {
    item.radius_m = finite_number(json, "radius_m", 0.0);
    if (!(item.radius_m > 0)) refuse("a radius that is not above 0");
  }
  if (item.kind == DrawingKind::kText) item.text = json.at("text").get<std::string>();
  return item;
}

}  // namespace

std::string_view place_kind_name(PlaceKind kind) {
  return kPlaceKinds.at(static_cast<std::size_t>(kind));
}

std::string_view loop_state_name(LoopState state) {
  return kLoopStates.at(static_cast<std::size_t>(state));
}

std::string_view drawing_kind_name(DrawingKind kind) {
  return kDrawingKinds.at(static_cast<std::size_t>(kind));
}

std::string_view drawing_colour_name(DrawingColour colour) {
  return kColours.at(static_cast<std::size_t>(colour));
}

void add_members(const Topology& topology, Written& json) {
  json["loop"] = loop_state_name(topology.loop);
  json["note"] = topology.note;
  Written& nodes = json["nodes"] = Written::array();
  for (const TopologyNode& node : topology.nodes) nodes.push_back(node_json(node));
  Written& edges = json["edges"] = Written::array();
  for (const TopologyEdge& edge : topology.edges)
    edges.push_back({{"from", edge.from},
                     {"to", edge.to},
                     {"length_m", sound(edge.length_m)},
                     {"confidence", sound(edge.confidence)},
                     {"quarter_turns", edge.quarter_turns}});
}

Topology topology_of(const Json& json) {
  Topology topology{.loop = choice<LoopState>(json, "loop", kLoopStates),
                    .note = json.at("note").get<std::string>()};
  std::set<std::uint32_t> ids;
  for (const Json& node : list_of(json, "nodes")) {
    topology.nodes.push_back(node_of(node));
    if (!ids.insert(topology.nodes.back().id).second)
      refuse("two nodes with the id " + std::to_string(topology.nodes.back().id));
  }
  for (const Json& edge : list_of(json, "edges")) {
    const TopologyEdge& added = topology.edges.emplace_back(edge_of(edge));
    for (const std::uint32_t end : {added.from, added.to}) {
      if (!ids.contains(end)) refuse("an edge to a node " + std::to_string(end) + " that is not there");
    }
  }
  return topology;
}

Written items_json(const Drawing& drawing) {
  Written items = Written::array();
  for (const DrawingItem& item : drawing) {
    Written json{{"kind", drawing_kind_name(item.kind)}, {"colour", drawing_colour_name(item.colour)}};
    if (item.closed) json["closed"] = true;
    Written& points = json["points_m"] = Written::array();
    for (const auto& [x, y] : item.points_m) points.push_back({sound(x), sound(y)});
    if (item.kind == DrawingKind::kCircle) json["radius_m"] = sound(item.radius_m);
    if (item.kind == DrawingKind::kText) json["text"] = item.text;
    items.push_back(std::move(json));
  }
  return items;
}

Drawing drawing_of(const Json& items) {
  if (!items.is_array()) refuse("items that are no list");
  Drawing drawing;
  for (const Json& item : items) drawing.push_back(item_of(item));
  return drawing;
}

}  // namespace hallway::log
