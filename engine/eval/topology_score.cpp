// SPDX-License-Identifier: MIT
#include "eval/topology_score.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "eval/assignment.hpp"

namespace hallway::eval {
namespace {

/// Several nodes may be at one place, as an opening and its edge; so near, either may be first.
constexpr double kSamePass_m = 0.1;

bool is_opening(const TrueNode& node) {
  return node.kind == TrueKind::kRoom || node.kind == TrueKind::kHallway;
}

/// Whether a charted node says what a true one is; a sweep says it of every opening.
bool is_of_kind(const log::TopologyNode& charted, const TrueNode& truth) {
  const bool is_hallway =
      charted.kind == log::PlaceKind::kHallwayEnd || charted.kind == log::PlaceKind::kJunction;
  const bool is_sweep = charted.kind == log::PlaceKind::kSweep;
  const bool is_step = charted.kind == log::PlaceKind::kDiscontinuity && charted.direction == truth.direction;
  switch (truth.kind) {
    case TrueKind::kStep:
      return is_step;
    case TrueKind::kWallEnd:
      return is_step || is_sweep || is_hallway;
    case TrueKind::kRoom:
      return charted.kind == log::PlaceKind::kRoom || is_sweep;
    case TrueKind::kHallway:
    case TrueKind::kDeadEnd:
      return is_hallway || is_sweep;
  }
  return false;
}

/// Whether a charted node is of the same sort as a true one, though not of its kind or direction.
bool is_of_sort(const log::TopologyNode& charted, const TrueNode& truth) {
  return (charted.kind == log::PlaceKind::kDiscontinuity) == (truth.kind == TrueKind::kStep) &&
         truth.kind != TrueKind::kDeadEnd;
}

/// Compares the nodes of a chart, by their ids, with the true ones.
class NodeScorer {
 public:
  NodeScorer(const std::vector<log::TopologyNode>& charted, const TopologyTruth& truth, const DrivenWay& way,
             double gate_m)
      : charted_(charted), truth_(truth), gate_m_(gate_m), is_assigned_(truth.nodes.size(), false) {
    for (const log::TopologyNode& node : charted) {
      ScoredNode& scored = scored_.emplace_back();
      scored.id = node.id;
      if (const auto pose = way.at(node.t_ns)) scored.place = pose->world({node.x_m, node.y_m});
    }
  }

  std::vector<ScoredNode> score() {
    // A sweep gives way to a node that says which kind the opening is.
    assign_nodes(is_of_kind, [&](std::size_t i, const TrueNode& truth) {
      if (!truth.is_demanded) return NodeVerdict::kAccepted;
      const bool is_open = is_opening(truth) && charted_[i].kind == log::PlaceKind::kSweep;
      return is_open ? NodeVerdict::kUndecided : NodeVerdict::kFound;
    });
    assign_nodes([](const log::TopologyNode& charted,
                    const TrueNode& truth) { return truth.is_demanded && is_of_sort(charted, truth); },
                 [](std::size_t, const TrueNode&) { return NodeVerdict::kWrongKind; });
    for (std::size_t i = 0; i < scored_.size(); ++i) {
      if (!scored_[i].true_node && has_true_node(i)) scored_[i].verdict = NodeVerdict::kDuplicate;
    }
    return std::move(scored_);
  }

 private:
  /// The distance of a charted node from a true one, if it is within the gate.
  std::optional<double> near(std::size_t i, const TrueNode& truth) const {
    if (!scored_[i].place) return std::nullopt;
    const double distance_m = truth.distance_to(*scored_[i].place);
    return distance_m <= gate_m_ ? std::optional(distance_m) : std::nullopt;
  }

  bool has_true_node(std::size_t i) const {
    return std::ranges::any_of(truth_.nodes, [&](const TrueNode& truth) {
      return is_of_kind(charted_[i], truth) && near(i, truth).has_value();
    });
  }

  /// Assigns what is left, where `may_be` allows it.
  template <typename MayBe, typename VerdictOf>
  void assign_nodes(const MayBe& may_be, const VerdictOf& verdict_of) {
    std::vector<CandidatePair> candidates;
    for (std::size_t i = 0; i < charted_.size(); ++i) {
      if (scored_[i].true_node) continue;
      for (std::size_t k = 0; k < truth_.nodes.size(); ++k) {
        if (is_assigned_[k] || !may_be(charted_[i], truth_.nodes[k])) continue;
        const bool is_sweep = charted_[i].kind == log::PlaceKind::kSweep;
        if (const auto distance_m = near(i, truth_.nodes[k]))
          candidates.push_back({i, k, *distance_m + (is_sweep ? gate_m_ : 0.0)});
      }
    }
    const auto pairs = assign(charted_.size(), truth_.nodes.size(), candidates);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (!pairs[i]) continue;
      const TrueNode& truth = truth_.nodes[*pairs[i]];
      is_assigned_[*pairs[i]] = true;
      scored_[i].true_node = pairs[i];
      scored_[i].distance_m = near(i, truth);
      scored_[i].verdict = verdict_of(i, truth);
    }
  }

  const std::vector<log::TopologyNode>& charted_;
  const TopologyTruth& truth_;
  double gate_m_;
  std::vector<bool> is_assigned_;  ///< by true node
  std::vector<ScoredNode> scored_;
};

/// The least way from one of some passes to the next of others.
/// @param slack_m  how much before the one the other may be
std::optional<double> least_way(const std::vector<double>& from, const std::vector<double>& to,
                                double slack_m) {
  std::optional<double> least_m;
  for (const double begin : from) {
    const auto end = std::ranges::upper_bound(to, begin - slack_m);
    if (end != to.end()) least_m = std::min(least_m.value_or(*end - begin), *end - begin);
  }
  return least_m;
}

/// The true ways of edges, from the passes of charted nodes.
class EdgeScorer {
 public:
  EdgeScorer(const std::vector<log::TopologyNode>& charted, const DrivenWay& way, double gate_m)
      : way_(way), gate_m_(gate_m) {
    for (const log::TopologyNode& node : charted) nodes_[node.id] = &node;
  }

  ScoredEdge score(const log::TopologyEdge& edge) {
    const double slack_m = edge.from == edge.to ? 0.0 : kSamePass_m;
    return {edge.from, edge.to, edge.length_m, least_way(passes(edge.from), passes(edge.to), slack_m)};
  }
  /// Whether the robot once drove the edge's way from its one node to its other one, with a length within the tolerance.
  bool was_driven(const log::TopologyEdge& edge, const ScoreSettings& settings) {
    for (const double begin : passes(edge.from)) {
      for (const double end : passes(edge.to)) {
        const double way_m = std::max(0.0, end - begin);
        if (end < begin - kSamePass_m || (edge.from == edge.to && way_m == 0.0)) continue;
        if (std::abs(edge.length_m - way_m) <= settings.gate_m + settings.length_share * way_m) return true;
      }
    }
    return false;
  }
  /// Whether an edge leads to a node that was met no later than the one where it begins; false where the chart does not have both.
  bool closes(const log::TopologyEdge& edge) const {
    const auto from = nodes_.find(edge.from), to = nodes_.find(edge.to);
    return from != nodes_.end() && to != nodes_.end() && to->second->t_ns <= from->second->t_ns;
  }

 private:
  const std::vector<double>& passes(std::uint32_t id) {
    const auto [found, is_new] = passes_.try_emplace(id);
    const auto node = nodes_.find(id);
    if (is_new && node != nodes_.end())
      found->second = way_.passes(node->second->t_ns, {node->second->x_m, node->second->y_m}, gate_m_);
    return found->second;
  }

  const DrivenWay& way_;
  double gate_m_;
  std::map<std::uint32_t, const log::TopologyNode*> nodes_;
  std::map<std::uint32_t, std::vector<double>> passes_;
};

LoopVerdict judge_loop(const log::Topology& chart, const TopologyTruth& truth, EdgeScorer& edges,
                       const ScoreSettings& settings) {
  if (chart.loop == log::LoopState::kOpen) return LoopVerdict::kOpen;
  if (chart.loop == log::LoopState::kUncertain) return LoopVerdict::kUncertain;
  const auto is_right = [&](const log::TopologyEdge& edge) {
    return !edges.closes(edge) || edges.was_driven(edge, settings);
  };
  return truth.came_around && std::ranges::all_of(chart.edges, is_right) ? LoopVerdict::kRightly
                                                                         : LoopVerdict::kWrongly;
}

void count_nodes(const TopologyTruth& truth, TopologyScore& score) {
  TopologyMetrics& metrics = score.metrics;
  std::vector<const ScoredNode*> owner(truth.nodes.size(), nullptr);
  std::vector<double> distances;
  for (const ScoredNode& node : score.nodes) {
    switch (node.verdict) {
      case NodeVerdict::kFound:
        ++metrics.found;
        break;
      case NodeVerdict::kUndecided:
        ++metrics.undecided;
        break;
      case NodeVerdict::kWrongKind:
        ++metrics.wrong_kind;
        break;
      case NodeVerdict::kAccepted:
        ++metrics.accepted;
        break;
      case NodeVerdict::kDuplicate:
        ++metrics.duplicates;
        break;
      case NodeVerdict::kFalse:
        ++metrics.false_nodes;
        break;
    }
    if (!node.true_node) continue;
    owner[*node.true_node] = &node;
    distances.push_back(*node.distance_m);
  }
  metrics.charted = score.nodes.size();
  metrics.place_m = statistics_of(std::move(distances));
  for (std::size_t k = 0; k < truth.nodes.size(); ++k) {
    if (!truth.nodes[k].is_demanded) continue;
    ++metrics.demanded;
    if (owner[k] == nullptr) score.missed.push_back(k);
    if (!is_opening(truth.nodes[k])) continue;
    ++metrics.openings;
    if (owner[k] != nullptr) ++metrics.openings_found;
    if (owner[k] != nullptr && owner[k]->verdict == NodeVerdict::kFound) ++metrics.openings_right;
  }
  metrics.missed = score.missed.size();
}

void score_edges(const log::Topology& chart, EdgeScorer& edges, TopologyScore& score) {
  std::map<std::uint32_t, bool> is_true;
  for (const ScoredNode& node : score.nodes) is_true[node.id] = node.true_node.has_value();
  std::vector<double> errors;
  for (const log::TopologyEdge& edge : chart.edges) {
    if (!is_true[edge.from] || !is_true[edge.to]) continue;
    const ScoredEdge& scored = score.edges.emplace_back(edges.score(edge));
    if (scored.true_m) errors.push_back(std::abs(scored.length_m - *scored.true_m));
  }
  std::ranges::sort(score.edges, {},
                    [](const ScoredEdge& edge) { return std::tuple(edge.from, edge.to, edge.length_m); });
  score.metrics.edges = score.edges.size();
  score.metrics.edges_not_driven = score.edges.size() - errors.size();
  score.metrics.length_m = statistics_of(std::move(errors));
}

}  // namespace

TopologyScore score_topology(const log::Topology& chart, const TopologyTruth& truth, const DrivenWay& way,
                             const ScoreSettings& settings) {
  std::vector<log::TopologyNode> nodes = chart.nodes;
  std::ranges::sort(nodes, {}, &log::TopologyNode::id);
  TopologyScore score;
  score.nodes = NodeScorer(nodes, truth, way, settings.gate_m).score();
  count_nodes(truth, score);
  EdgeScorer edges(nodes, way, settings.gate_m);
  score_edges(chart, edges, score);
  score.metrics.loop = judge_loop(chart, truth, edges, settings);
  score.metrics.came_around = truth.came_around;
  return score;
}

}  // namespace hallway::eval
