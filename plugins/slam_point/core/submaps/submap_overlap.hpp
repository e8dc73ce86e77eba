// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_point/core/frame/frame.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point {

/// How much of a frame the first frames of submaps saw too: landmarks that both saw over those that either saw.
class SubmapOverlap {
 public:
  /// With the active submap. O(points).
  static double with_active(const SubmapGraph& graph, const Observations& frame);

  /// The submap with the largest overlap of at least `least`, the oldest of equal ones; kNone where there is none.
  /// O(places of the landmarks in view).
  Index best(const SubmapGraph& graph, const Observations& frame, double least);

 private:
  std::vector<std::uint32_t> shared_;  // submap -> landmarks in view of its first frame; 0 between calls
  std::vector<Index> sharing_;         // submaps where that is not 0
};

}  // namespace hallway::slam_point
