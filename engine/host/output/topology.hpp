// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>
#include <hallway/topology.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hallway::host {

/// The topological map that a plugin put, checked, in memory that is used again.
class Topology {
 public:
  /// Copies one and checks it: what topology.h demands. Throws Malformed. O((nodes + edges) log nodes).
  /// @param topology  as large as version 1.6 has it, or larger
  /// @param frame     that is answered, after which no node may be; null in report()
  void set(const hw_topology_t& topology, const hw_frame_t* frame);

  /// In the order put; ids distinct.
  std::span<const hw_topology_node_t> nodes() const { return nodes_; }
  /// In the order put, between those nodes.
  std::span<const hw_topology_edge_t> edges() const { return edges_; }
  /// HW_LOOP_….
  std::uint32_t loop() const { return loop_; }
  /// UTF-8.
  const std::string& note() const { return note_; }

 private:
  void check_nodes(const hw_frame_t* frame);
  void check_edges() const;

  std::vector<hw_topology_node_t> nodes_;
  std::vector<hw_topology_edge_t> edges_;
  std::uint32_t loop_ = HW_LOOP_OPEN;
  std::string note_;
  std::vector<std::uint32_t> sorted_ids_;
};

}  // namespace hallway::host
