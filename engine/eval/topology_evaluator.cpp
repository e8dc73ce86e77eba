// SPDX-License-Identifier: MIT
#include "eval/topology_evaluator.hpp"

#include "eval/topology_truth.hpp"

namespace hallway::eval {

std::optional<TopologyScore> TopologyEvaluator::score() const {
  if (!topology_) return std::nullopt;
  DrivenWay way;
  SpillList<TimedPose>::Reader reader(poses_);
  while (const TimedPose* pose = reader.next()) way.add(pose->t_ns, pose->pose);
  return score_topology(*topology_, find_truth(plan_, way), way);
}

}  // namespace hallway::eval
