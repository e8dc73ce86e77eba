// SPDX-License-Identifier: MIT
#include "bsp/point_location.hpp"

namespace hallway::bsp {

std::uint32_t leaf_at(const Tree& tree, const Vec3& point) {
  if (tree.nodes.empty()) return 0;
  std::int32_t at = 0;
  while (at >= 0) {
    const Node& node = tree.nodes[static_cast<std::size_t>(at)];
    at = node.child[node.plane.distance(point) < 0.0 ? 1 : 0];
  }
  return static_cast<std::uint32_t>(~at);
}

}  // namespace hallway::bsp
