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

/// What lies on one side of a node's plane: another node or a leaf. It already tells the axis of that node's plane, or whether
/// that leaf is solid, so that a walk knows how to go on before it has read anything there.
class Child {
 public:
  static constexpr std::uint32_t kOblique = 3;                   ///< an axis() for planes along no axis
  static constexpr std::uint32_t kMost = 1u << 29;               ///< nodes that a tree may have, and leaves
  constexpr Child() : bits_(kLeafBit | kSolidBit) {}             ///< leaf 0, solid
  constexpr explicit Child(std::uint32_t bits) : bits_(bits) {}  ///< as bits() gave them

  /// @param axis  the positive axis along which the node's normal points, or kOblique
  static constexpr Child node(std::uint32_t index, std::uint32_t axis) { return Child(index << 2 | axis); }
  static constexpr Child leaf(std::uint32_t index, Content content) {
    return Child(kLeafBit | (content == Content::kSolid ? kSolidBit : 0) | index);
  }

  constexpr bool is_leaf() const { return (bits_ & kLeafBit) != 0; }
  constexpr bool is_solid() const { return (bits_ & kSolidBit) != 0; }  ///< of a leaf
  constexpr std::uint32_t axis() const { return bits_ & 3; }            ///< of a node
  constexpr std::uint32_t index() const { return is_leaf() ? bits_ & ~(kLeafBit | kSolidBit) : bits_ >> 2; }
  constexpr std::uint32_t bits() const { return bits_; }
  friend constexpr bool operator==(Child, Child) = default;

 private:
  static constexpr std::uint32_t kLeafBit = 1u << 31;
  static constexpr std::uint32_t kSolidBit = 1u << 30;
  std::uint32_t bits_;
};

/// An inner node: space is divided by its plane. What walks read most is kept together, the rest in Tree::normals.
struct Node {
  double offset = 0.0;           ///< of the plane, metres
  std::array<Child, 2> child{};  ///< [0] in front of the plane, where the normal points; [1] behind it
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
  Child root;                 ///< node 0, or the one leaf where nothing is divided
  std::vector<Node> nodes;    ///< as set_nodes() makes them
  std::vector<Vec3> normals;  ///< of the nodes' planes, unit length
  std::vector<Leaf> leaves;
  /// Polygons of csg::Surface (by index) that bound a leaf or lie in it, each leaf's in rising order.
  std::vector<std::uint32_t> leaf_faces;
  Box bounds;                  ///< of the world with a margin; beyond it everything is as empty as outside
  std::uint32_t clusters = 0;  ///< number of clusters

  Plane plane(std::uint32_t node) const { return {normals[node], nodes[node].offset}; }
  /// Signed distance of a point from the plane of a node, positive in front.
  double distance(Child node, const Vec3& point) const {
    const std::uint32_t i = node.index();
    const std::uint32_t axis = node.axis();
    return (axis == Child::kOblique ? normals[i].dot(point) : point[axis]) - nodes[i].offset;
  }
};

/// A node as it is made.
struct Division {
  Plane plane;  ///< metres, unit normal
  /// [0] in front, [1] behind. At least 0: index of a division; negative: leaf ~child.
  std::array<std::int32_t, 2> child{};
};

/// Gives a tree, whose leaves are there, its nodes; the first is the root. None: the whole space is leaf 0. Throws
/// Error{kBadInput} for more than Child::kMost nodes or leaves.
void set_nodes(Tree& tree, const std::vector<Division>& divisions);

}  // namespace hallway::bsp
