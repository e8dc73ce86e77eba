// SPDX-License-Identifier: MIT
#include "em/core/neighbours.hpp"

#include <algorithm>
#include <array>

namespace hallway::em {
namespace {

constexpr double kWiden = 1.5;  // of the radius when too few points are within: 3.4 times the volume

// A function object: sorting inlines it.
constexpr auto kNearer = [](const NearPoint& left, const NearPoint& right) {
  return left.squared_distance != right.squared_distance ? left.squared_distance < right.squared_distance
                                                         : left.place < right.place;
};

/// Of a block's points from a place; a loop of fixed length, so that compilers use vectors.
std::array<double, kBlockSize> squared_distances(const Points& points, std::size_t begin, const Vec3& from) {
  std::array<double, kBlockSize> result;
  const double* x = &points.x[begin];
  const double* y = &points.y[begin];
  const double* z = &points.z[begin];
  for (std::size_t k = 0; k < kBlockSize; ++k) {
    const double dx = x[k] - from.x();
    const double dy = y[k] - from.y();
    const double dz = z[k] - from.z();
    result[k] = dx * dx + dy * dy + dz * dz;
  }
  return result;
}

void within(const PointField& field, const Ball& ball, std::vector<NearPoint>& found) {
  found.clear();
  const double limit = ball.radius * ball.radius;
  field.tree.visit_blocks(ball, [&](std::size_t block) {
    const std::size_t begin = block * kBlockSize;
    const std::array<double, kBlockSize> squared = squared_distances(field.points, begin, ball.middle);
    for (std::size_t k = 0; k < kBlockSize; ++k) {
      if (squared[k] <= limit) found.push_back({squared[k], static_cast<std::uint32_t>(begin + k)});
    }
  });
}

}  // namespace

void nearest(const PointField& field, const Vec3& p, std::size_t most, double radius,
             std::vector<NearPoint>& found) {
  const std::size_t wanted = std::min(most, field.points.count);
  found.clear();
  if (wanted == 0) return;
  if (!(radius > 0.0)) radius = 1e-9 * (1.0 + p.norm());
  Ball ball{p, radius};
  for (within(field, ball, found); found.size() < wanted; within(field, ball, found)) ball.radius *= kWiden;
  const auto end = found.begin() + static_cast<std::ptrdiff_t>(wanted);
  std::nth_element(found.begin(), end - 1, found.end(), kNearer);
  std::sort(found.begin(), end, kNearer);
  found.erase(end, found.end());
}

}  // namespace hallway::em
