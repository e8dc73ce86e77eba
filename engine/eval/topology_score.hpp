// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "eval/driven_way.hpp"
#include "eval/error_statistics.hpp"
#include "eval/topology_truth.hpp"
#include "log/topology.hpp"

namespace hallway::eval {

/// What is true of a charted node.
enum class NodeVerdict : std::uint8_t {
  kFound,      ///< a demanded true node of its kind is there
  kUndecided,  ///< a sweep at an opening whose kind it leaves open
  kWrongKind,  ///< a demanded true node is there, of another kind or direction
  kAccepted,   ///< a true node is there that a chart may have or not
  kDuplicate,  ///< a true node of its kind is there, which another charted node is assigned to
  kFalse,      ///< nothing of its kind is there
};

/// What is true of what a chart says of its loop.
enum class LoopVerdict : std::uint8_t {
  kOpen,       ///< it does not say that it closed one
  kUncertain,  ///< it says that it does not know
  kRightly,    ///< it closed one, and the robot came round by every edge that closes it
  kWrongly,    ///< it closed one otherwise
};

/// A charted node beside the truth.
struct ScoredNode {
  std::uint32_t id = 0;
  NodeVerdict verdict = NodeVerdict::kFalse;
  std::optional<Vec2> place;  ///< world, by the true pose at its time; empty where that is not known
  std::optional<std::size_t> true_node;  ///< index in TopologyTruth::nodes, of the first four verdicts
  std::optional<double> distance_m;      ///< from there
};

/// A charted edge beside the truth.
struct ScoredEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  double length_m = 0.0;
  /// The least way that the robot drove from a pass of the one node to the next pass of the other one; empty where it drove none.
  std::optional<double> true_m;
};

/// A charted topology against the truth. Numbers of nodes: demanded = found + undecided + wrong_kind + missed;
/// charted = found + undecided + wrong_kind + accepted + duplicates + false_nodes.
struct TopologyMetrics {
  std::uint64_t demanded = 0;  ///< true nodes that a chart has to have
  std::uint64_t charted = 0;
  std::uint64_t found = 0;
  std::uint64_t undecided = 0;
  std::uint64_t wrong_kind = 0;
  std::uint64_t missed = 0;
  std::uint64_t accepted = 0;
  std::uint64_t duplicates = 0;
  std::uint64_t false_nodes = 0;
  std::uint64_t openings = 0;          ///< demanded ones, to rooms and hallways
  std::uint64_t openings_found = 0;    ///< of whatever kind the chart says
  std::uint64_t openings_right = 0;    ///< of the right kind
  std::uint64_t edges = 0;             ///< charted ones between nodes that are neither false nor duplicates
  std::uint64_t edges_not_driven = 0;  ///< of these, those that the robot did not drive
  std::optional<ErrorStatistics> place_m;   ///< distances of charted nodes from their true ones
  std::optional<ErrorStatistics> length_m;  ///< errors of the edges that were driven
  LoopVerdict loop = LoopVerdict::kOpen;
  bool came_around = false;  ///< the robot did come round a loop
};

/// What is compared, with the metrics.
struct TopologyScore {
  TopologyMetrics metrics;
  std::vector<ScoredNode> nodes;    ///< by id
  std::vector<ScoredEdge> edges;    ///< those of TopologyMetrics::edges, by ids and length
  std::vector<std::size_t> missed;  ///< indices in TopologyTruth::nodes
};

/// How near is the same place.
struct ScoreSettings {
  double gate_m = 0.75;
  double length_share = 0.05;  ///< of an edge's true way: how much more it may be off to close a loop rightly
};

/// Scores a charted topology.
///
/// Nodes are assigned to true ones one to one, as many as possible and by the least sum of distances: first to nodes of their kind, then what is left to
/// demanded openings of the other kind and to demanded steps of the other direction. A closed loop is right if the robot came around and
/// the way of every edge that leads to a node met no later than its begin was once driven, from any pass of the one to any later pass of the other, with a length within `gate_m` and `length_share`. The order
/// of nodes and edges does not matter; ids are unique. O(n * poses) for n charted nodes, and assign().
TopologyScore score_topology(const log::Topology& chart, const TopologyTruth& truth, const DrivenWay& way,
                             const ScoreSettings& settings = {});

}  // namespace hallway::eval
