// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/kd_tree.hpp"
#include "icp/core/types.hpp"

namespace hallway::icp {

/// The normal of the surface about each point, of unit length and either sense, by principal component analysis of its `neighbours` nearest
/// points (itself included); zero where these lie on a line or at one place, or are fewer than three. O(n k log n).
///
/// @param points  what `tree` was made of
Points normals_of(const Points& points, const KdTree& tree, std::size_t neighbours);

}  // namespace hallway::icp
