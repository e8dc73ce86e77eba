// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "slam_point/core/types.hpp"

namespace hallway::slam_point {

/// Points in a tree of squares (Dimensions 2, by x and y) or cubes (3) that overlap their neighbours by the reach, so that all points near a place
/// stand in the one leaf that holds it (thesis 6.2.4), and which points join and leave one by one (6.5.1). A point stands in every leaf whose
/// widened cell holds it. Looking near a place costs O(log n), adding and far moves O(log n) for each of those leaves.
///
/// Points are named by consecutive numbers from 0.
template <int Dimensions>
class OverlapTree {
 public:
  /// `reach_m` > 0: the largest distance that visit_near() is asked for [m].
  explicit OverlapTree(double reach_m);

  /// Adds the point with the next number. Coordinates are finite.
  void add(const Vec3& p);

  /// Tells that point `i` is now at `p`.
  void move(std::uint32_t i, const Vec3& p);

  /// Takes point `i` out for good; its number is not used again.
  void remove(std::uint32_t i);

  /// Calls visit(i) once for each point of the leaf that holds p: a superset of the points within reach_m.
  template <typename Visit>
  void visit_near(const Vec3& p, Visit&& visit) const {
    if (nodes_.empty()) return;
    for (const std::uint32_t i : nodes_[leaf_of(p)].points) visit(i);
  }

  void clear();

 private:
  static constexpr std::uint32_t kChildren = 1u << Dimensions;
  static constexpr std::uint32_t kNoChildren = 0;  // the root is nobody's child

  struct Node {
    std::uint32_t first_child = kNoChildren;
    std::vector<std::uint32_t> points;  // of a leaf
  };
  struct Cell {
    Vec3 centre = Vec3::Zero();
    double half = 0.0;
  };

  static Cell child_of(const Cell& cell, std::uint32_t child);
  Vec3 clamped(const Vec3& p) const;
  bool holds(const Cell& cell, const Vec3& p) const;
  std::uint32_t leaf_of(const Vec3& p) const;
  void put(std::uint32_t i);
  void insert(std::uint32_t node, const Cell& cell, std::uint32_t i);
  void erase(std::uint32_t node, const Cell& cell, std::uint32_t i);
  void split(std::uint32_t node, const Cell& cell);

  double overlap_;  // more than the reach, so that small moves change nothing
  double slack2_;   // how far a point may stray from where it was put, squared
  double largest_;  // coordinates beyond count as this
  Cell root_;
  std::vector<Node> nodes_;
  std::vector<Vec3> put_;  // by point: where it was put; NaN when it was removed
};

extern template class OverlapTree<2>;
extern template class OverlapTree<3>;

}  // namespace hallway::slam_point
