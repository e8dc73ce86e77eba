// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "eval/topology_evaluator.hpp"
#include "run/feed/frame_feed.hpp"
#include "run/sources/source.hpp"

namespace hallway::run {

/// Scores the topology that a pipeline charts, where the source knows its floor plan and the true poses.
class TopologyScorer {
 public:
  /// @param folder  where the true poses are kept, see SpillList
  TopologyScorer(const Source& source, const std::filesystem::path& folder);

  /// A frame, answered or not: its true pose, if that has an orientation.
  void add(const FrameAnswer& answer);
  /// The topology that the last plugin has now; none without a plan.
  void set_topology(log::Topology topology);

  /// Empty without a plan or a topology.
  std::optional<eval::TopologyScore> score() const;

 private:
  std::optional<eval::TopologyEvaluator> evaluator_;  ///< where there is a plan
};

}  // namespace hallway::run
