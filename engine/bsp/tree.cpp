// SPDX-License-Identifier: MIT
#include "bsp/tree.hpp"

#include "base/error.hpp"

namespace hallway::bsp {
namespace {

std::uint32_t axis_of(const Vec3& normal) {
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    if (normal == Vec3::Unit(axis)) return axis;
  }
  return Child::kOblique;
}

}  // namespace

void set_nodes(Tree& tree, const std::vector<Division>& divisions) {
  if (divisions.size() > Child::kMost || tree.leaves.size() > Child::kMost) {
    throw Error(ErrorCode::kBadInput, "the world is divided into more than 2^29 cells");
  }
  const auto child = [&](std::int32_t at) {
    if (at < 0) {
      const auto leaf = static_cast<std::uint32_t>(~at);
      return Child::leaf(leaf, tree.leaves[leaf].content);
    }
    const auto node = static_cast<std::uint32_t>(at);
    return Child::node(node, axis_of(divisions[node].plane.normal));
  };
  tree.root = child(divisions.empty() ? ~0 : 0);
  tree.nodes.clear();
  tree.normals.clear();
  for (const Division& division : divisions) {
    tree.nodes.push_back({division.plane.offset, {child(division.child[0]), child(division.child[1])}});
    tree.normals.push_back(division.plane.normal);
  }
}

}  // namespace hallway::bsp
