// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "em/core/points.hpp"
#include "em/core/types.hpp"
#include "em/core/workers.hpp"

namespace hallway::em {

/// Axis-parallel box by its middle and half sizes.
struct Box {
  Vec3 middle = Vec3::Zero();
  Vec3 half = Vec3::Zero();
};

/// What lies within `height` of a plane and within a rectangle on it.
struct Slab {
  PlaneFrame frame;
  double height = 0.0;
  double low_a = 0.0, high_a = 0.0;  ///< the rectangle along frame.u ...
  double low_b = 0.0, high_b = 0.0;  ///< ... and along frame.v
};

/// A slab as boxes are held against it.
class SlabTest {
 public:
  explicit SlabTest(const Slab& slab)
      : slab_(slab),
        normal_(slab.frame.normal.cwiseAbs()),
        u_(slab.frame.u.cwiseAbs()),
        v_(slab.frame.v.cwiseAbs()) {}

  /// False if no point of `box` lies inside; true may be wrong.
  bool touches(const Box& box) const {
    const Vec3 from = box.middle - slab_.frame.origin;
    if (std::abs(slab_.frame.normal.dot(from)) > slab_.height + normal_.dot(box.half)) return false;
    const double a = slab_.frame.u.dot(from);
    const double reach_a = u_.dot(box.half);
    if (a + reach_a < slab_.low_a || a - reach_a > slab_.high_a) return false;
    const double b = slab_.frame.v.dot(from);
    const double reach_b = v_.dot(box.half);
    return b + reach_b >= slab_.low_b && b - reach_b <= slab_.high_b;
  }

 private:
  const Slab& slab_;
  Vec3 normal_, u_, v_;  ///< sizes of their components
};

/// What lies within a radius of a point.
struct Ball {
  Vec3 middle = Vec3::Zero();
  double radius = 0.0;

  /// Whether a point of `box` lies inside.
  bool touches(const Box& box) const {
    const Vec3 outside = ((box.middle - middle).cwiseAbs() - box.half).cwiseMax(0.0);
    return outside.squaredNorm() <= radius * radius;
  }
};

/// Boxes about the blocks of a list of points, and boxes about eight of those, and so on: the points are in
/// Morton order, so neighbours in the list make small boxes. Building takes O(n); a query passes over what
/// its shape does not touch.
class BoxTree {
 public:
  /// Keeps nothing of `points` but their number.
  BoxTree(const Points& points, Workers& workers);

  /// Calls visit(block) for each block whose box `shape` touches, in ascending order.
  template <typename Shape, typename Visit>
  void visit_blocks(const Shape& shape, Visit&& visit) const {
    if (!levels_.empty()) descend(levels_.size() - 1, 0, levels_.back().size(), shape, visit);
  }

  /// Points of a chunk: of a part of the list that a query can be made on alone.
  static constexpr std::size_t kChunkSize = kBlockSize * 64;

  /// Number of chunks, the last of which may have fewer points.
  std::size_t chunks() const {
    return levels_.empty() ? 0 : (levels_.front().size() * kBlockSize + kChunkSize - 1) / kChunkSize;
  }

  /// As visit_blocks(), in the blocks of chunk `chunk` alone.
  template <typename Shape, typename Visit>
  void visit_chunk(std::size_t chunk, const Shape& shape, Visit&& visit) const {
    if (levels_.size() > kChunkLevel) {
      descend(kChunkLevel, chunk, chunk + 1, shape, visit);
    } else {
      visit_blocks(shape, visit);
    }
  }

  /// Box of one block.
  const Box& block_box(std::size_t block) const { return levels_.front()[block]; }

 private:
  static constexpr std::size_t kFan = 8;
  static constexpr std::size_t kChunkLevel =
      2;  // a chunk is a node of this level, or all where there is no such level

  template <typename Shape, typename Visit>
  void descend(std::size_t level, std::size_t begin, std::size_t end, const Shape& shape,
               Visit& visit) const {
    for (std::size_t node = begin; node < end; ++node) {
      if (!shape.touches(levels_[level][node])) continue;
      if (level == 0) {
        visit(node);
      } else {
        descend(level - 1, node * kFan, std::min((node + 1) * kFan, levels_[level - 1].size()), shape, visit);
      }
    }
  }

  std::vector<std::vector<Box>> levels_;  ///< blocks first, the last has at most kFan
};

}  // namespace hallway::em
