// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geom/box.hpp"
#include "geom/plane.hpp"

namespace hallway::bsp {

/// What fills a leaf.
enum class Content : std::uint8_t {
  kEmpty,  ///< where robots drive and light passes
  kSolid,  ///< inside a brush, or beyond the walls of a sealed world
};

/// An inner node: space is divided by its plane.
struct Node {
  Plane plane;  ///< metres, unit normal
  /// [0] in front of the plane, where the normal points; [1] behind it. At least 0: index of a node; negative: leaf ~child.
  std::array<std::int32_t, 2> child{};
};

/// A convex cell of space.
struct Leaf {
  Content content = Content::kEmpty;
  std::int32_t cluster = -1;     ///< unit of visibility that it belongs to; -1 where it is solid
  Box box;                       ///< metres; cells at the rim end at the tree's bounds
  std::uint32_t first_face = 0;  ///< its faces in Tree::leaf_faces
  std::uint32_t face_count = 0;
};

/// A binary space partition of a world, as data. A point exactly on a node's plane belongs to the front.
struct Tree {
  std::vector<Node> nodes;  ///< the root is 0; empty where the whole space is the one leaf 0
  std::vector<Leaf> leaves;
  /// Polygons of csg::Surface (by index) that bound a leaf or lie in it, each leaf's in rising order.
  std::vector<std::uint32_t> leaf_faces;
  Box bounds;                  ///< of the world with a margin; beyond it everything is as empty as outside
  std::uint32_t clusters = 0;  ///< number of clusters
};

}  // namespace hallway::bsp
