// SPDX-License-Identifier: MIT
#include "record/plugin_topology.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace hallway::record {

log::Topology copy_topology(const host::Topology& topology) {
  log::Topology copy{.loop = static_cast<log::LoopState>(topology.loop()), .note = topology.note()};
  copy.nodes.reserve(topology.nodes().size());
  for (const hw_topology_node_t& node : topology.nodes()) {
    log::TopologyNode& added =
        copy.nodes.emplace_back(log::TopologyNode{.id = node.id,
                                                  .kind = static_cast<log::PlaceKind>(node.kind - 1),
                                                  .direction = node.direction,
                                                  .visits = node.visits,
                                                  .t_ns = node.t_ns,
                                                  .x_m = node.x_m,
                                                  .y_m = node.y_m});
    if (!std::isnan(node.size_m)) added.size_m = node.size_m;
  }
  copy.edges.reserve(topology.edges().size());
  for (const hw_topology_edge_t& edge : topology.edges())
    copy.edges.push_back({.from = edge.from,
                          .to = edge.to,
                          .length_m = edge.length_m,
                          .confidence = edge.confidence,
                          .quarter_turns = edge.quarter_turns});
  return copy;
}

log::Drawing copy_drawing(const host::Drawing& drawing) {
  log::Drawing copy;
  copy.reserve(drawing.items().size());
  for (const host::DrawingItem& item : drawing.items()) {
    log::DrawingItem& added =
        copy.emplace_back(log::DrawingItem{.kind = static_cast<log::DrawingKind>(item.kind - 1),
                                           .colour = static_cast<log::DrawingColour>(item.colour),
                                           .closed = item.closed,
                                           .radius_m = item.radius_m,
                                           .text = item.text});
    for (const hw_drawing_point_t& point : drawing.points_of(item))
      added.points_m.push_back({point.x_m, point.y_m});
  }
  return copy;
}

nlohmann::ordered_json describe_topology(const log::Topology& topology) {
  return {{"nodes", topology.nodes.size()},
          {"edges", topology.edges.size()},
          {"loop", log::loop_state_name(topology.loop)}};
}

}  // namespace hallway::record
