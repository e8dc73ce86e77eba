// SPDX-License-Identifier: MIT
#pragma once

#include "slam_point/core/moving/motion_tracks.hpp"
#include "slam_point/core/places/map_parts.hpp"
#include "slam_point/core/submaps/segment_store.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"
#include "slam_point/core/types.hpp"

namespace hallway::slam_point {

/// A pose in the frame that `anchor` is in, moved to the frame of `anchor`. Where that is the same frame, nothing is rounded.
Pose seen_from(const Pose& anchor, const Pose& pose);
/// The same of a covariance of position and rotation.
Mat6 seen_from(const Pose& anchor, const Mat6& covariance);

/// What a map is reported from: one part of the graph, in the frame of its anchor.
struct MapSource {
  const SubmapGraph& graph;
  const MapParts& parts;
  const std::vector<MotionTracks::Track>& moving;
  Index part = kNone;
  LandmarkId first_id = 0;             ///< id of landmark 0
  std::uint32_t min_observations = 0;  ///< from which on a landmark counts as mapped
};

/// The map as it is. O(map).
Map report_map(const MapSource& source);

/// The map as all evidence in `segments` places it together (refine_map), with covariances.
Map report_refined_map(const MapSource& source, const SegmentStore& segments);

}  // namespace hallway::slam_point
