// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "em/core/types.hpp"

namespace hallway::em {

/// A box at any angle.
struct OrientedBox {
  Vec3 centre = Vec3::Zero();
  std::array<Vec3, 3> axes{};  ///< unit, perpendicular
  Vec3 half = Vec3::Zero();    ///< half length along each axis

  bool contains(const Vec3& p) const {
    const Vec3 d = p - centre;
    return std::abs(axes[2].dot(d)) <= half[2] && std::abs(axes[0].dot(d)) <= half[0] &&
           std::abs(axes[1].dot(d)) <= half[1];
  }
  /// False only if no point of the box about `middle` with sides along the coordinate axes lies inside.
  bool touches(const Vec3& middle, const Vec3& half_sides) const;
};

/// A point and how far it is.
struct Neighbour {
  double squared_distance = 0.0;
  std::uint32_t place = 0;

  bool operator<(const Neighbour& other) const {
    return squared_distance != other.squared_distance ? squared_distance < other.squared_distance
                                                      : place < other.place;
  }
};

/// A kd-tree (in the place of the overlapping quadtree of thesis 3.5.3). What it finds, and in which order, follows from
/// the points alone. O(n log n) to build; it refers to the points, which outlive it.
class PointTree {
 public:
  explicit PointTree(std::span<const Vec3> points);

  /// The `count` points nearest to `p`, nearest first; fewer where the cloud has fewer. O(count log n) on the whole.
  std::vector<Neighbour> nearest(const Vec3& p, std::size_t count) const;

  /// Places of the points within a box, ascending.
  std::vector<std::uint32_t> within(const OrientedBox& box) const;

 private:
  struct Node {
    Vec3 middle = Vec3::Zero();  ///< of the box of its points
    Vec3 half = Vec3::Zero();
    std::uint32_t begin = 0, end = 0;   ///< in order_
    std::uint32_t left = 0, right = 0;  ///< 0 for a leaf
  };

  std::uint32_t build(std::uint32_t begin, std::uint32_t end);
  void measure(Node& node) const;
  void search(std::uint32_t index, const Vec3& p, std::size_t count, std::vector<Neighbour>& heap) const;
  void collect(std::uint32_t index, const OrientedBox& box, std::vector<std::uint32_t>& found) const;

  std::span<const Vec3> points_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace hallway::em
