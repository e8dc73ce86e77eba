// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "icp/core/types.hpp"

namespace hallway::icp {

/// A point of a tree, as an answer.
struct Neighbour {
  std::uint32_t index = 0;    ///< its number in the list that the tree was made of
  double distance2_m2 = 0.0;  ///< squared distance from the place that was asked about
};

/// Nearest neighbours among points that do not change: a balanced kd-tree. Exact; of points at the same distance the one with the
/// smallest x, y, z comes first, so that answers do not depend on the order of the points. Build O(n log n), question O(log n) on average.
class KdTree {
 public:
  /// @param points  all finite; copied
  explicit KdTree(std::span<const Vec3> points);

  std::size_t size() const { return points_.size(); }

  /// The nearest point within `most_m` (inclusive) of `place`; none where there is no such point.
  std::optional<Neighbour> nearest(const Vec3& place, double most_m) const;

  /// Replaces `found` by the `count` nearest points, nearest first; fewer where the tree has fewer.
  void nearest(const Vec3& place, std::size_t count, std::vector<Neighbour>& found) const;

 private:
  /// A range of points_; inner ones are cut at the point in their middle.
  struct Range {
    std::uint32_t begin = 0, end = 0;
  };
  template <typename Found>
  void search(Range range, const Vec3& place, Found& found) const;
  void build(Range range, std::span<const Vec3> given);

  Points points_;                       // in the tree's order
  std::vector<std::uint32_t> numbers_;  // of points_, in the list that was given
  std::vector<std::uint8_t> axes_;      // of the cut at a middle point
};

}  // namespace hallway::icp
