// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sense/trajectory.hpp"

namespace hallway::sense {

/// A body that stays at one pose.
class StandingBody final : public Trajectory {
 public:
  /// @param pose  T_world_body
  explicit StandingBody(const Pose& pose) : pose_(pose) {}
  Pose pose_at(std::int64_t) const override { return pose_; }
  Kinematics kinematics_at(std::int64_t, double, Side) const override { return {.T_world_body = pose_}; }
  std::vector<double> breaks_in(std::int64_t, std::int64_t) const override { return {}; }

 private:
  Pose pose_;
};

}  // namespace hallway::sense
