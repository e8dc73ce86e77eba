// SPDX-License-Identifier: MIT
#include "em/core/slab_points.hpp"

#include <array>
#include <cmath>

namespace hallway::em {
namespace {

/// Signed distances of a block's points from the plane; a loop of fixed length, so that compilers use
/// vectors.
std::array<double, kBlockSize> heights(const Points& points, std::size_t begin, const PlaneFrame& frame) {
  std::array<double, kBlockSize> result;
  const double* x = &points.x[begin];
  const double* y = &points.y[begin];
  const double* z = &points.z[begin];
  const Vec3 n = frame.normal;
  const Vec3 o = frame.origin;
  for (std::size_t k = 0; k < kBlockSize; ++k) {
    result[k] = n.x() * (x[k] - o.x()) + n.y() * (y[k] - o.y()) + n.z() * (z[k] - o.z());
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
    const std::array<double, kBlockSize> height = heights(points_, begin, slab_.frame);
    std::size_t count = 0;
    for (std::size_t k = 0; k < kBlockSize; ++k) {
      if (!(std::abs(height[k]) <= slab_.height)) continue;  // so that NaN is outside
      const Vec3 from = points_.at(begin + k) - slab_.frame.origin;
      const double a = slab_.frame.u.dot(from);
      const double b = slab_.frame.v.dot(from);
      if (a < slab_.low_a || a > slab_.high_a || b < slab_.low_b || b > slab_.high_b) continue;
      place_[count] = static_cast<std::uint32_t>(begin + k);
      a_[count] = a;
      b_[count] = b;
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
  std::array<double, kBlockSize> a_{}, b_{}, height_{};
};

}  // namespace

void collect(const PointField& field, const Slab& slab, SlabPoints& found) {
  field.tree.visit_blocks(slab, BlockCollector(field, slab, found));
}

void collect_chunk(const PointField& field, std::size_t chunk, const Slab& slab, SlabPoints& found) {
  field.tree.visit_chunk(chunk, slab, BlockCollector(field, slab, found));
}

}  // namespace hallway::em
