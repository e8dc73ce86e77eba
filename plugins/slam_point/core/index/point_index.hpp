// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <variant>

#include "geometry/hash_grid.hpp"
#include "slam_point/core/index/kd_tree.hpp"
#include "slam_point/core/index/overlap_tree.hpp"

namespace hallway::slam_point {

/// Structures that find points near a place (thesis 6.6.2).
enum class IndexKind : int { grid = 0, quadtree = 1, octree = 2, kdtree = 3 };

/// Their names, by number.
inline constexpr const char* kIndexNames[] = {"grid", "quadtree", "octree", "kdtree"};

/// Points, named by consecutive numbers from 0, in one of those structures. They differ in cost alone: each visits a superset of the points within reach, in
/// an order that callers must not depend on.
class PointIndex {
 public:
  /// `reach_m` > 0: the largest distance that visit_near() is asked for [m].
  PointIndex(IndexKind kind, double reach_m) : index_(make(kind, reach_m)) {}

  /// Adds the point with the next number. Coordinates are finite.
  void add(const Vec3& p) {
    std::visit([&](auto& index) { index.add(p); }, index_);
  }

  /// Tells that point `i` is now at `p`.
  void move(std::uint32_t i, const Vec3& p) {
    if (HashGrid* grid = std::get_if<HashGrid>(&index_)) return grid->move(i, p);
    std::visit([&](auto& index) { index.move(i, p); }, index_);
  }

  /// Takes point `i` out for good; its number is not used again.
  void remove(std::uint32_t i) {
    std::visit([&](auto& index) { index.remove(i); }, index_);
  }

  /// Calls visit(i) once for each point within reach_m of p and some farther ones.
  template <typename Visit>
  void visit_near(const Vec3& p, Visit&& visit) const {
    // Branches, unlike std::visit, let the compiler put `visit` into the loop.
    if (const HashGrid* grid = std::get_if<HashGrid>(&index_)) return grid->visit_near(p, visit);
    if (const auto* quadtree = std::get_if<OverlapTree<2>>(&index_)) return quadtree->visit_near(p, visit);
    if (const auto* octree = std::get_if<OverlapTree<3>>(&index_)) return octree->visit_near(p, visit);
    std::get_if<KdTree>(&index_)->visit_near(p, visit);
  }

  void clear() {
    std::visit([](auto& index) { index.clear(); }, index_);
  }

 private:
  using Index = std::variant<HashGrid, OverlapTree<2>, OverlapTree<3>, KdTree>;

  static Index make(IndexKind kind, double reach_m) {
    switch (kind) {
      case IndexKind::quadtree:
        return OverlapTree<2>(reach_m);
      case IndexKind::octree:
        return OverlapTree<3>(reach_m);
      case IndexKind::kdtree:
        return KdTree(reach_m);
      case IndexKind::grid:
        break;
    }
    return HashGrid(reach_m);
  }

  Index index_;
};

}  // namespace hallway::slam_point
