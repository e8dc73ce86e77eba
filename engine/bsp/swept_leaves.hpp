// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "bsp/body_shape.hpp"
#include "bsp/pending_stack.hpp"
#include "bsp/tree.hpp"

namespace hallway::bsp {

/// Calls visit(leaf) for the leaves that a moving shape may touch at a time from 0 to `limit`, sooner ones first as far as the planes
/// tell. visit() may lower `limit`: what is touched only later is then left out. A shape that comes within rounding of a leaf
/// touches it if it is given a margin.
template <typename Visit>
void visit_swept_leaves(const Tree& tree, const BodyShape& shape, const Vec3& from, const Vec3& motion,
                        const double& limit, Visit&& visit) {
  struct Part {
    Child at;
    double begin, end;  // of the motion
  };
  // Leaves of a part the times at which start + slope * time is not below zero.
  const auto clip = [](Part part, double start, double slope) {
    if (slope > 0.0) {
      part.begin = std::max(part.begin, -start / slope);
    } else if (slope < 0.0) {
      part.end = std::min(part.end, -start / slope);
    } else if (start < 0.0) {
      part.end = -1.0;
    }
    return part;
  };
  PendingStack<Part> rest;
  rest.push({tree.root, 0.0, 1.0});
  while (!rest.empty()) {
    const Part part = rest.pop();
    if (part.begin > part.end || part.begin > limit) continue;
    if (part.at.is_leaf()) {
      visit(part.at.index());
      continue;
    }
    const Node& node = tree.nodes[part.at.index()];
    const Vec3& normal = tree.normals[part.at.index()];
    const double distance = tree.distance(part.at, from);
    const double speed = normal.dot(motion);
    Part front = clip(part, distance + shape.reach(normal), speed);
    Part back = clip(part, shape.reach(-normal) - distance, -speed);
    front.at = node.child[0];
    back.at = node.child[1];
    if (back.begin < front.begin) std::swap(front, back);
    rest.push(back);
    rest.push(front);
  }
}

}  // namespace hallway::bsp
