// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "bsp/pending_stack.hpp"
#include "bsp/query_limits.hpp"
#include "bsp/tree.hpp"

namespace hallway::bsp {

/// Calls visit(leaf) for all leaves of a tree, the farthest first: no leaf hides anything of one that is visited after it, as seen from
/// `eye` (metres). The faces of a leaf hide nothing of each other where they show their front to the eye; a polygon that stands
/// in several leaves is ordered by its parts in them, not as a whole.
///
/// Throws Error{kBadInput} as check_query_point() does. O(nodes). Fuchs, Kedem, Naylor: "On visible surface generation by a priori
/// tree structures", SIGGRAPH 1980.
template <typename Visit>
void back_to_front(const Tree& tree, const Vec3& eye, Visit&& visit) {
  check_query_point(eye);
  PendingStack<Child> rest;
  rest.push(tree.root);
  while (!rest.empty()) {
    Child at = rest.pop();
    while (!at.is_leaf()) {
      const Node& node = tree.nodes[at.index()];
      const std::size_t near = tree.distance(at, eye) < 0.0 ? 1 : 0;
      rest.push(node.child[near]);
      at = node.child[1 - near];
    }
    visit(at.index());
  }
}

}  // namespace hallway::bsp
