// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "slam_point/core/frame/frame_matcher.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"
#include "slam_point/core/types.hpp"

namespace hallway::slam_point {

/// Covariance of a placed frame's pose against the map, as Answer::covariance has it, in the map's frame; the frame's observations are in
/// their landmarks already. `noise2_m2`: estimated variance of a coordinate of an observation, 0 while it is not known. Empty then, and
/// where the points leave a direction open. O(points).
std::optional<Mat6> pose_covariance(const SubmapGraph& graph, const std::vector<Observation>& frame,
                                    const Pose& T_map_sensor, double noise2_m2, bool planar);

/// A covariance of position and rotation in the frame that `anchor` is in, as told: in the frame of `anchor`.
Mat6 told_from(const Pose& anchor, const Mat6& covariance);

}  // namespace hallway::slam_point
