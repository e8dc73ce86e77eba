// SPDX-License-Identifier: MIT
#include "em/core/slab_points.hpp"

#include <array>
#include <cmath>

namespace hallway::em {
namespace {

using BlockValues = std::array<double, kBlockSize>;

/// How far each point of a block lies from `origin` along `axis`; a loop of fixed length, so that compilers use vectors.
BlockValues along(const Points& points, std::size_t begin, const Vec3& origin, const Vec3& axis) {
  BlockValues result;
  const double* x = &points.x[begin];
  const double* y = &points.y[begin];
  const double* z = &points.z[begin];
  for (std::size_t k = 0; k < kBlockSize; ++k) {
    result[k] =
        axis.x() * (x[k] - origin.x()) + axis.y() * (y[k] - origin.y()) + axis.z() * (z[k] - origin.z());
  }
  return result;
}

/// Adds what one block has inside of a slab.
class BlockCollector {
 public:
  BlockCollector(const PointField& field, const Slab& slab, SlabPoints& found)
      : points_(field.points), slab_(slab), found_(found) {
    found_.place.clear();
    found_.a.clear();
    found_.b.clear();
    found_.height.clear();
  }

  void operator()(std::size_t block) {
    const std::size_t begin = block * kBlockSize;
    const PlaneFrame& frame = slab_.frame;
    const BlockValues height = along(points_, begin, frame.origin, frame.normal);
    std::size_t near = 0;
    for (std::size_t k = 0; k < kBlockSize; ++k) {
      near_[near] = k;
      near += std::abs(height[k]) <= slab_.height ? 1u : 0u;  // so that NaN is outside
    }
    if (near == 0) return;
    const BlockValues a = along(points_, begin, frame.origin, frame.u);
    const BlockValues b = along(points_, begin, frame.origin, frame.v);
    std::size_t count = 0;
    for (std::size_t n = 0; n < near; ++n) {
      const std::size_t k = near_[n];
      if (a[k] < slab_.low_a || a[k] > slab_.high_a || b[k] < slab_.low_b || b[k] > slab_.high_b) continue;
      place_[count] = static_cast<std::uint32_t>(begin + k);
      a_[count] = a[k];
      b_[count] = b[k];
      height_[count++] = height[k];
    }
    append(found_.place, place_, count);
    append(found_.a, a_, count);
    append(found_.b, b_, count);
    append(found_.height, height_, count);
  }

 private:
  template <typename Value>
  static void append(std::vector<Value>& list, const std::array<Value, kBlockSize>& values,
                     std::size_t count) {
    list.insert(list.end(), values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
  }

  const Points& points_;
  const Slab& slab_;
  SlabPoints& found_;
  std::array<std::uint32_t, kBlockSize> place_{};  ///< of the block's points inside
  BlockValues a_{}, b_{}, height_{};
  std::array<std::size_t, kBlockSize> near_{};  ///< of the block's points those within the height
};

}  // namespace

void collect(const PointField& field, const Slab& slab, SlabPoints& found) {
  field.tree.visit_blocks(SlabTest(slab), BlockCollector(field, slab, found));
}

void collect_chunk(const PointField& field, std::size_t chunk, const Slab& slab, SlabPoints& found) {
  field.tree.visit_chunk(chunk, SlabTest(slab), BlockCollector(field, slab, found));
}

}  // namespace hallway::em
