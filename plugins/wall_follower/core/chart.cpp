// SPDX-License-Identifier: MIT
#include "wall_follower/core/chart.hpp"

#include <algorithm>

namespace hallway::wall_follower {

void Chart::add(Node node, double confidence) {
  node.id = static_cast<std::uint32_t>(nodes.size());
  if (!nodes.empty()) {
    const Node& last = nodes.back();
    edges.push_back(
        {last.id, node.id, std::max(0.0, node.way_m - last.way_m), confidence, node.quarter - last.quarter});
  }
  nodes.push_back(node);
  ++changes;
}

}  // namespace hallway::wall_follower
