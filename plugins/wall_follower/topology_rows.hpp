// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "wall_follower/core/chart.hpp"

namespace hallway::wall_follower {

/// A chart as topologies have it: corners and what is hidden are landmarks for closing a loop, but no nodes.
struct TopologyRows {
  std::vector<Node> nodes;  ///< with their ids
  std::vector<Edge>
      edges;  ///< over what is left out: lengths and turns are summed, the confidence is the least
};

/// O(nodes + edges). A loop without any node has no edges.
inline TopologyRows topology_rows(const Chart& chart) {
  const auto is_kept = [&](std::uint32_t id) {
    return chart.nodes[id].kind != Kind::corner && !chart.nodes[id].is_hidden;
  };
  TopologyRows rows;
  for (const Node& node : chart.nodes) {
    if (is_kept(node.id)) rows.nodes.push_back(node);
  }
  // Edge i leads from node i, in the order of the way; that of the last node closes the loop.
  const auto next = [&](const Edge& edge) -> const Edge* {
    return edge.to < chart.edges.size() ? &chart.edges[edge.to] : nullptr;
  };
  for (const Edge& first : chart.edges) {
    if (!is_kept(first.from)) continue;
    Edge joined = first;
    const Edge* edge = &first;
    for (std::size_t count = 0; !is_kept(joined.to) && count < chart.edges.size(); ++count) {
      edge = next(*edge);
      if (edge == nullptr) break;
      joined.to = edge->to;
      joined.length_m += edge->length_m;
      joined.quarter_turns += edge->quarter_turns;
      joined.confidence = edge->confidence < joined.confidence ? edge->confidence : joined.confidence;
    }
    if (is_kept(joined.to)) rows.edges.push_back(joined);
  }
  return rows;
}

}  // namespace hallway::wall_follower
