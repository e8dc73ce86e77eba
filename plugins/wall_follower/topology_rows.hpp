// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "wall_follower/core/chart.hpp"

namespace hallway::wall_follower {

/// A chart as topologies have it: corners and what is hidden are landmarks for closing a loop, but no nodes.
struct TopologyRows {
  std::vector<Node> nodes;  ///< with their ids
  std::vector<Edge>
      edges;  ///< over what is left out: lengths and turns are summed, the confidence is the least
};

/// O((nodes + edges) log nodes). A loop without any node has no edges.
inline TopologyRows topology_rows(const Chart& chart) {
  const auto is_kept = [&](std::uint32_t id) {
    const Node& node = chart.node(id);
    return node.kind != Kind::corner && !node.is_hidden;
  };
  TopologyRows rows;
  for (const Node& node : chart.nodes) {
    if (is_kept(node.id)) rows.nodes.push_back(node);
  }
  std::map<std::uint32_t, const Edge*> next;  // along the wall, by the landmark where it begins
  for (const Edge& edge : chart.edges) {
    if (!edge.is_crossing) next[edge.from] = &edge;
  }
  for (const Edge& first : chart.edges) {
    if (!is_kept(first.from)) continue;
    Edge joined = first;
    for (std::size_t count = 0; !is_kept(joined.to) && count < chart.edges.size(); ++count) {
      const auto found = next.find(joined.to);
      if (found == next.end()) break;
      const Edge& edge = *found->second;
      joined.to = edge.to;
      joined.length_m += edge.length_m;
      joined.quarter_turns += edge.quarter_turns;
      joined.confidence = std::min(joined.confidence, edge.confidence);
    }
    if (is_kept(joined.to)) rows.edges.push_back(joined);
  }
  return rows;
}

}  // namespace hallway::wall_follower
