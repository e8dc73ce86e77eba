// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point {

/// Covariances of the landmarks of a graph at its least-squares solution, for observations whose coordinates have the variance 1:
/// of their errors relative to the map as a whole, that is after the rigid fit to the truth by the landmarks `in_gauge`.
///
/// The poses' covariance is the inverse of the reduced system's matrix, and a landmark's follows from the blocks that join the
/// submaps it stands in; those are in the pattern of the factor (BlockCholesky::invert). Holding submap 0 is undone by projecting
/// the fit out of the errors. Empty for landmarks without evidence; nothing at all where the system or the fit is singular. In
/// a planar graph nothing moves along z.
std::vector<std::optional<Mat3>> landmark_covariances(const SubmapGraph& graph,
                                                      const std::vector<bool>& in_gauge);

}  // namespace hallway::slam_point
