// SPDX-License-Identifier: MIT
#include "run/scoring/topology_scorer.hpp"

#include <utility>

namespace hallway::run {

TopologyScorer::TopologyScorer(const Source& source, const std::filesystem::path& folder) {
  if (auto plan = source.floor_plan()) evaluator_.emplace(*std::move(plan), folder);
}

void TopologyScorer::add(const FrameAnswer& answer) {
  const std::optional<Pose>& pose = answer.frame.T_world_body;
  if (evaluator_ && pose && answer.frame.orientation_known) evaluator_->add_pose(answer.frame.t_ns(), *pose);
}

void TopologyScorer::set_topology(log::Topology topology) {
  if (evaluator_) evaluator_->set_topology(std::move(topology));
}

std::optional<eval::TopologyScore> TopologyScorer::score() const {
  return evaluator_ ? evaluator_->score() : std::nullopt;
}

}  // namespace hallway::run
