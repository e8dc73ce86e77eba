// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "slam_point/core/submaps/segment_store.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point {

/// The map as all evidence places it together.
struct RefinedMap {
  std::vector<Pose> poses;      ///< T_map_submap of each submap
  std::vector<Vec3> positions;  ///< of each landmark, map frame [m]; only of those with evidence
  double noise2_m2 = 0.0;       ///< estimated variance of one coordinate of an observation
  /// Of each landmark, empty where it has no evidence or the noise cannot be estimated: the covariance of its error relative
  /// to the map as a whole, that is when the map is fitted rigidly to the truth by its landmarks `in_gauge` [m^2].
  std::vector<std::optional<Mat3>> covariances;
};

/// Places the segments by least squares, each by itself, with all landmarks: what batch maximum likelihood comes to but for
/// what the segments have condensed. Begins with the submaps of `graph` placed as wholes. `in_gauge[l]` says whether landmark l
/// belongs to those that the map is fitted by.
///
/// Sparse Cholesky over six unknowns a segment: seconds for some thousand segments that overlap. Where the work would exceed
/// some 2e10 multiplications, submaps stay whole and no covariances are stated.
RefinedMap refine_map(const SubmapGraph& graph, const SegmentStore& store, const std::vector<bool>& in_gauge);

}  // namespace hallway::slam_point
