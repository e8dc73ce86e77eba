// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hallway::log {

/// What a place of a topological map is.
enum class PlaceKind { kDiscontinuity, kSweep, kRoom, kHallwayEnd, kJunction };

/// The kind's name in files: "discontinuity", "sweep", "room", "hallway_end" or "junction".
std::string_view place_kind_name(PlaceKind kind);

/// Whether a topological map has a closed loop.
enum class LoopState { kOpen, kClosed, kUncertain };

/// The state's name in files: "open", "closed" or "uncertain".
std::string_view loop_state_name(LoopState state);

/// A place of a topological map, as hw_topology_node_t has it.
struct TopologyNode {
  std::uint32_t id = 0;
  PlaceKind kind = PlaceKind::kDiscontinuity;
  std::int32_t direction =
      0;  ///< of a discontinuity: 1 the wall goes on farther from the robot, -1 nearer; else 0
  std::optional<double>
      size_m{};  ///< of a discontinuity: the step of the wall, infinite where there is none behind
  std::uint32_t visits = 0;
  std::int64_t t_ns = 0;  ///< when the robot was abreast of it the first time
  double x_m = 0;         ///< then, in the body's frame
  double y_m = 0;

  friend bool operator==(const TopologyNode&, const TopologyNode&) = default;
};

/// A way from one place to another.
struct TopologyEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  double length_m = 0;
  double confidence = 0;           ///< 0 to 1
  std::int32_t quarter_turns = 0;  ///< to the left positive

  friend bool operator==(const TopologyEdge&, const TopologyEdge&) = default;
};

/// The topological map of a plugin.
struct Topology {
  LoopState loop = LoopState::kOpen;
  std::string note{};                 ///< UTF-8; why the loop is so
  std::vector<TopologyNode> nodes{};  ///< ids distinct
  std::vector<TopologyEdge> edges{};  ///< between nodes

  friend bool operator==(const Topology&, const Topology&) = default;
};

/// Reads topology.json (docs/formats.md). Throws Error{kBadInput} with the cause for a text that is no such document, has ids twice or edges to
/// nodes that are not there. O(n log n).
/// @param file  its name, for messages
Topology parse_topology(std::string_view text, const std::string& file);

/// parse_topology() of a file. Throws Error{kIo} if it cannot be read.
Topology read_topology(const std::filesystem::path& path);

/// The text that parse_topology() reads back to the same values. Throws Error{kInternal} for a number that is not finite where it must be.
std::string print_topology(const Topology& topology);

/// The same as GraphML, for other programs: nodes `n7`, directed edges, the members as attributes of the names in topology.json. What JSON leaves out is
/// left out; an infinite size is INF.
std::string print_graphml(const Topology& topology);

}  // namespace hallway::log
