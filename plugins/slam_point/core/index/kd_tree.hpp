// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_point/core/types.hpp"

namespace hallway::slam_point {

/// Points in a kd-tree whose leaves hold a few each (Bentley 1975; thesis 6.6.2), and which points join and leave one by one: a part that has grown
/// lopsided is built anew (scapegoat, Galperin and Rivest 1993). Looking near a place costs O(log n) and what it finds; adding and far moves O(log^2 n)
/// over time.
///
/// Points are named by consecutive numbers from 0.
class KdTree {
 public:
  /// `reach_m` > 0: the largest distance that visit_near() is asked for [m].
  explicit KdTree(double reach_m);

  /// Adds the point with the next number. Coordinates are finite.
  void add(const Vec3& p);

  /// Tells that point `i` is now at `p`.
  void move(std::uint32_t i, const Vec3& p);

  /// Takes point `i` out for good; its number is not used again.
  void remove(std::uint32_t i);

  /// Calls visit(i) once for each point of the leaves that a ball of reach_m about p touches: a superset of the points within reach_m.
  template <typename Visit>
  void visit_near(const Vec3& p, Visit&& visit) const {
    if (!nodes_.empty()) visit_below(0, p, visit);
  }

  void clear();

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  struct Node {
    std::uint32_t parent = kNone;
    std::uint32_t low = kNone;  // children; a leaf has none
    std::uint32_t high = kNone;
    std::uint32_t count = 0;  // points below
    int axis = 0;
    double border = 0.0;                // low: coordinates <= border; high: >= border
    std::vector<std::uint32_t> points;  // of a leaf
  };

  template <typename Visit>
  void visit_below(std::uint32_t n, const Vec3& p, Visit&& visit) const {
    while (nodes_[n].low != kNone) {
      const double off = p[nodes_[n].axis] - nodes_[n].border;
      if (off > reach_) {
        n = nodes_[n].high;
      } else if (off < -reach_) {
        n = nodes_[n].low;
      } else {
        visit_below(nodes_[n].low, p, visit);
        n = nodes_[n].high;
      }
    }
    for (const std::uint32_t i : nodes_[n].points) visit(i);
  }

  std::uint32_t leaf_of(const Vec3& p) const;
  void insert(std::uint32_t i);
  void erase(std::uint32_t i);
  void count(std::uint32_t leaf, std::int32_t change);
  std::uint32_t lopsided_above(std::uint32_t leaf) const;
  void rebuild(std::uint32_t n);
  void collect(std::uint32_t n, std::vector<std::uint32_t>& points);
  void build(std::uint32_t n, std::uint32_t* begin, std::uint32_t* end);
  std::uint32_t make_node(std::uint32_t parent);

  double reach_;   // with what a point may stray
  double slack2_;  // how far it may, squared
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> free_;
  std::vector<Vec3> put_;            // by point: where it was put
  std::vector<std::uint32_t> leaf_;  // by point; kNone when it was removed
};

}  // namespace hallway::slam_point
