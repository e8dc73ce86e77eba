// SPDX-License-Identifier: MIT
#include "host/output/topology.hpp"

#include <algorithm>
#include <cmath>

#include "host/output/plugin_text.hpp"
#include "host/samples/strided.hpp"

namespace hallway::host {
namespace {

/// Copies a list over another one.
template <typename T>
void copy_list(const void* first, std::uint64_t count, std::uint32_t stride, std::uint64_t most,
               const char* what, std::vector<T>& list) {
  if (count > most) throw Malformed{fmt::format("{} {}, more than {}", count, what, most)};
  list.clear();
  Strided<T>(first, count, stride).append_to(list);
}

/// What is wrong with a node, null if nothing.
const char* node_problem(const hw_topology_node_t& node) {
  if (!std::isfinite(node.x_m) || !std::isfinite(node.y_m)) return "a place that is not finite";
  if (node.kind == HW_TOPOLOGY_DISCONTINUITY) {
    if (node.direction != 1 && node.direction != -1) return "a direction that is neither 1 nor -1";
    return node.size_m >= 0 ? nullptr : "a size that is no number from 0 on";
  }
  if (node.direction != 0) return "a direction, and is no discontinuity";
  return std::isnan(node.size_m) ? nullptr : "a size, and is no discontinuity";
}

const char* edge_problem(const hw_topology_edge_t& edge) {
  if (!std::isfinite(edge.length_m) || edge.length_m < 0) return "a length that is no number from 0 on";
  if (!(edge.confidence >= 0 && edge.confidence <= 1)) return "a confidence outside of 0 to 1";
  return nullptr;
}

}  // namespace

void Topology::set(const hw_topology_t& topology, const hw_frame_t* frame) {
  if (topology.loop > HW_LOOP_UNCERTAIN)
    throw Malformed{fmt::format("the unknown state {} of its loop", topology.loop)};
  loop_ = topology.loop;
  copy_list(topology.nodes, topology.n_nodes, topology.node_stride, HW_MAX_TOPOLOGY_NODES, "nodes", nodes_);
  copy_list(topology.edges, topology.n_edges, topology.edge_stride, HW_MAX_TOPOLOGY_EDGES, "edges", edges_);
  note_ = copy_plugin_text(topology.note, HW_MAX_NOTE_BYTES, "note");
  check_nodes(frame);
  check_edges();
}

void Topology::check_nodes(const hw_frame_t* frame) {
  sorted_ids_.clear();
  for (const hw_topology_node_t& node : nodes_) {
    if (node.kind < HW_TOPOLOGY_DISCONTINUITY || node.kind > HW_TOPOLOGY_JUNCTION)
      throw Malformed{fmt::format("node {} has the unknown kind {}", node.id, node.kind)};
    if (const char* problem = node_problem(node))
      throw Malformed{fmt::format("node {} has {}", node.id, problem)};
    if (frame != nullptr && node.t_ns > frame->t_ns)
      throw Malformed{fmt::format("node {} has a time after the frame's", node.id)};
    sorted_ids_.push_back(node.id);
  }
  std::ranges::sort(sorted_ids_);
  const auto twice = std::ranges::adjacent_find(sorted_ids_);
  if (twice != sorted_ids_.end()) throw Malformed{fmt::format("two nodes have the id {}", *twice)};
}

void Topology::check_edges() const {
  for (const hw_topology_edge_t& edge : edges_) {
    for (const std::uint32_t end : {edge.from, edge.to}) {
      if (!std::ranges::binary_search(sorted_ids_, end))
        throw Malformed{
            fmt::format("an edge from {} to {}, and there is no node {}", edge.from, edge.to, end)};
    }
    if (const char* problem = edge_problem(edge))
      throw Malformed{fmt::format("the edge from {} to {} has {}", edge.from, edge.to, problem)};
  }
}

}  // namespace hallway::host
