// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hallway::slam_plane::spatial {

void append_moved(const Pose& T, std::span<const Vec3> from, std::vector<Vec3>& to) {
  for (const Vec3& p : from) to.push_back(T * p);
}

double area(const Convex& polygon) {
  return std::abs(polygon_area(polygon));
}

double overlap_area(const Convex& a, const Convex& b) {
  if (a.size() < 3 || b.size() < 3) return 0.0;
  Convex both = a;
  for (std::size_t i = 0; i < b.size() && both.size() >= 3; ++i) {
    const Vec2& from = b[i];
    const Vec2 outward = -left_of(b[(i + 1) % b.size()] - from);
    both = clip(both, outward, outward.dot(from));
  }
  return area(both);
}

double distance(const Convex& a, const Convex& b) {
  if (overlap_area(a, b) > 0.0) return 0.0;
  double least = std::numeric_limits<double>::max();
  for (const auto& [corners, sides] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    const std::size_t n = sides->size();
    for (const Vec2& p : *corners) {
      for (std::size_t i = 0; i < n; ++i) {
        const Vec2 &from = (*sides)[i], run = (*sides)[(i + 1) % n] - from;
        const double length2 = std::max(run.squaredNorm(), std::numeric_limits<double>::min());
        const double share = std::clamp(run.dot(p - from) / length2, 0.0, 1.0);
        least = std::min(least, (from + share * run - p).norm());
      }
    }
  }
  return least;
}

void simplify(Convex& polygon, std::size_t most) {
  while (polygon.size() > std::max<std::size_t>(most, 3)) {
    const std::size_t n = polygon.size();
    std::size_t least = 0;
    double loss = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2& before = polygon[(i + n - 1) % n];
      const double lost = std::abs(cross(polygon[i] - before, polygon[(i + 1) % n] - before));
      if (lost < loss) {
        loss = lost;
        least = i;
      }
    }
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(least));
  }
}

}  // namespace hallway::slam_plane::spatial
