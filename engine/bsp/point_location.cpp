// SPDX-License-Identifier: MIT
#include "bsp/point_location.hpp"

namespace hallway::bsp {

std::uint32_t leaf_at(const Tree& tree, const Vec3& point) {
  Child at = tree.root;
  while (!at.is_leaf()) at = tree.nodes[at.index()].child[tree.distance(at, point) < 0.0 ? 1 : 0];
  return at.index();
}

}  // namespace hallway::bsp
