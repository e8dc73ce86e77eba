// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway {

/// A point of a tree, as an answer.
struct Neighbour {
  double distance2 = 0.0;   ///< squared, from the place that was asked about
  std::uint32_t index = 0;  ///< in the list that the tree was made of

  bool operator<(const Neighbour& other) const {
    return distance2 != other.distance2 ? distance2 < other.distance2 : index < other.index;
  }
};

/// Points that do not change: a balanced kd-tree. Its answers are exact; of points at the same distance the one with the smallest x, y, z comes first, then the
/// one that stands first in the list, so that answers do not depend on the order of the points. O(n log n) to build.
/// (slam_point has a kd-tree of its own, into which points come one by one.)
class KdTree {
 public:
  /// @param points  all finite; copied
  explicit KdTree(std::span<const Vec3> points);

  std::size_t size() const { return points_.size(); }

  /// The nearest point within `most_m` (inclusive) of `place`; none where there is no such point. O(log n) on average.
  std::optional<Neighbour> nearest(const Vec3& place, double most_m) const;

  /// Replaces `found` by the `count` nearest points, nearest first; fewer where the tree has fewer. O(count log n) on the whole.
  void nearest(const Vec3& place, std::size_t count, std::vector<Neighbour>& found) const;

  /// The points of a region, ascending. `region.contains(point)` decides; `region.touches(middle, half)` is false only if no point of
  /// the box about `middle` with sides along the axes and half lengths `half` lies in it.
  template <typename Region>
  std::vector<std::uint32_t> within(const Region& region) const {
    std::vector<std::uint32_t> found;
    if (!nodes_.empty()) collect(0, region, found);
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  struct Node {
    Vec3 middle = Vec3::Zero();  ///< of the box of its points
    Vec3 half = Vec3::Zero();
    std::uint32_t begin = 0, end = 0;   ///< in points_
    std::uint32_t left = 0, right = 0;  ///< 0 for a leaf
  };

  std::uint32_t build(std::span<const Vec3> given, std::uint32_t begin, std::uint32_t end);
  template <typename Found>
  void search(std::uint32_t index, const Vec3& place, Found& found) const;
  template <typename Region>
  void collect(std::uint32_t index, const Region& region, std::vector<std::uint32_t>& found) const {
    const Node& node = nodes_[index];
    if (!region.touches(node.middle, node.half)) return;
    if (node.left != 0) {
      collect(node.left, region, found);
      collect(node.right, region, found);
      return;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      if (region.contains(points_[i])) found.push_back(numbers_[i]);
    }
  }

  std::vector<Vec3> points_;            // in the tree's order
  std::vector<std::uint32_t> numbers_;  // of points_, in the list that was given
  std::vector<Node> nodes_;
};

}  // namespace hallway
