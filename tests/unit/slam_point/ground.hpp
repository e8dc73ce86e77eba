// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point {

/// Adds a submap, in the current part and at the origin, that saw each of these points so often, as new landmarks.
inline Index add_seen_submap(SubmapGraph& graph, const std::vector<Vec3>& points, std::uint32_t count) {
  const Index submap = graph.add_submap(Pose{});
  for (const Vec3& p : points) {
    const Index landmark = graph.add_landmark(p, 0);
    const Index member = graph.join(submap, landmark, p, true);
    graph.submaps[submap].members[member].count = count;
    graph.resum(landmark);
  }
  return submap;
}

}  // namespace hallway::slam_point
