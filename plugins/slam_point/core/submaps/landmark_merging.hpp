// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_point/core/frame/frame_matcher.hpp"
#include "slam_point/core/moving/motion_filter.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point {

/// Makes one of landmarks that came to lie on each other (thesis 6.5.2): of each member of `submap`, which is closed, and the
/// nearest other landmark within `separation_m`, the older one stays. Two that were seen together are two, so a moving point that
/// passes a landmark never becomes it. Matches in `frame` are made to follow. Returns how many were merged.
std::size_t merge_landmarks(SubmapGraph& graph, Index submap, double separation_m, FrameMatcher& matcher,
                            MotionFilter& motion_filter, std::vector<Observation>& frame);

}  // namespace hallway::slam_point
