// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "base/spill_list.hpp"
#include "eval/driven_way.hpp"
#include "eval/floor_plan.hpp"
#include "eval/topology_score.hpp"
#include "geometry/se3.hpp"
#include "log/topology.hpp"

namespace hallway::eval {

/// Scores the last topology that a plugin gave in a run. The true poses are in a folder, if there is one, until the score is asked for: memory does not grow
/// with the frames before.
class TopologyEvaluator {
 public:
  /// @param folder  see SpillList, as all that throws
  explicit TopologyEvaluator(FloorPlan plan, const std::filesystem::path& folder = {})
      : plan_(std::move(plan)), poses_(folder) {}

  /// The true pose at a frame, where it is known. Times rise.
  void add_pose(std::int64_t t_ns, const Pose& T_world_body) {
    poses_.push_back({t_ns, planar_part(T_world_body)});
  }
  /// What the plugin says of the whole map now: it replaces what it said before.
  void set_topology(log::Topology topology) { topology_ = std::move(topology); }

  /// Empty where the plugin gave no topology.
  std::optional<TopologyScore> score() const;

 private:
  struct TimedPose {
    std::int64_t t_ns;
    PlanarPose pose;
  };

  FloorPlan plan_;
  SpillList<TimedPose> poses_;
  std::optional<log::Topology> topology_;
};

}  // namespace hallway::eval
