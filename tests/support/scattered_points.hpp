// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "geometry/se3.hpp"

namespace hallway::test {

/// Points at random between two corners; always the same ones.
inline std::vector<Vec3> scattered(std::uint64_t count, const Vec3& low, const Vec3& high) {
  const Random random(3, stream_id("test"));
  std::vector<Vec3> points;
  for (std::uint64_t i = 0; i < count; ++i) {
    points.push_back({random.uniform(0, 3 * i, low.x(), high.x()),
                      random.uniform(0, 3 * i + 1, low.y(), high.y()),
                      random.uniform(0, 3 * i + 2, low.z(), high.z())});
  }
  return points;
}

}  // namespace hallway::test
