// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "geom/arrays.hpp"
#include "geometry/se3.hpp"
#include "log/run_log.hpp"

namespace hallway::run {

/// Where the body truly was when the sample ended; empty where that is not known, or was at the time of its frame.
inline std::optional<Pose> true_pose_of(const log::SampleTruth& truth) {
  if (!truth.position_m) return std::nullopt;
  const auto& [w, x, y, z] = truth.orientation;
  return Pose{Quat(w, x, y, z), to_vec3(*truth.position_m)};
}

}  // namespace hallway::run
