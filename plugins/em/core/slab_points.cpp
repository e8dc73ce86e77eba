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

}  // namespace

void collect(const PointField& field, const Slab& slab, SlabPoints& found) {
  found.place.clear();
  found.a.clear();
  found.b.clear();
  found.height.clear();
  field.tree.visit_blocks(slab, [&](std::size_t block) {
    const std::size_t begin = block * kBlockSize;
    const std::array<double, kBlockSize> height = heights(field.points, begin, slab.frame);
    for (std::size_t k = 0; k < kBlockSize; ++k) {
      if (!(std::abs(height[k]) <= slab.height)) continue;  // so that NaN is outside
      const Vec3 from = field.points.at(begin + k) - slab.frame.origin;
      const double a = slab.frame.u.dot(from);
      const double b = slab.frame.v.dot(from);
      if (a < slab.low_a || a > slab.high_a || b < slab.low_b || b > slab.high_b) continue;
      found.place.push_back(static_cast<std::uint32_t>(begin + k));
      found.a.push_back(a);
      found.b.push_back(b);
      found.height.push_back(height[k]);
    }
  });
}

}  // namespace hallway::em
