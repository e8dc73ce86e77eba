// SPDX-License-Identifier: MIT
#include "wall_follower/core/chart.hpp"

#include <algorithm>

namespace hallway::wall_follower {

void Chart::add(Node node, double confidence) {
  node.id = next_id_++;
  if (nodes.size() > wall_begin) {
    const Node& last = nodes.back();
    edges.push_back(
        {last.id, node.id, std::max(0.0, node.way_m - last.way_m), confidence, node.quarter - last.quarter});
  }
  nodes.push_back(node);
  ++changes;
}

Node& Chart::node(std::uint32_t id) {
  return *std::ranges::lower_bound(nodes, id, {}, &Node::id);
}

const Node& Chart::node(std::uint32_t id) const {
  return *std::ranges::lower_bound(nodes, id, {}, &Node::id);
}

bool Chart::has(std::uint32_t id) const {
  return std::ranges::binary_search(nodes, id, {}, &Node::id);
}

void Chart::remove(const std::vector<std::uint32_t>& ids) {
  if (ids.empty()) return;
  const auto is_out = [&](std::uint32_t id) { return std::ranges::find(ids, id) != ids.end(); };
  const auto before = static_cast<std::ptrdiff_t>(wall_begin);
  wall_begin -= static_cast<std::size_t>(std::count_if(nodes.begin(), nodes.begin() + before,
                                                       [&](const Node& node) { return is_out(node.id); }));
  std::erase_if(nodes, [&](const Node& node) { return is_out(node.id); });
  std::erase_if(edges, [&](const Edge& edge) { return is_out(edge.from) || is_out(edge.to); });
  ++changes;
}

}  // namespace hallway::wall_follower
