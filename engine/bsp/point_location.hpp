// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "bsp/tree.hpp"

namespace hallway::bsp {

/// The leaf that holds a point (metres); points beyond the bounds fall into a leaf at the rim. O(depth of the tree).
std::uint32_t leaf_at(const Tree& tree, const Vec3& point);

/// Cluster of the leaf that holds a point; -1 in solid and outside.
inline std::int32_t cluster_at(const Tree& tree, const Vec3& point) {
  return tree.leaves[leaf_at(tree, point)].cluster;
}

}  // namespace hallway::bsp
