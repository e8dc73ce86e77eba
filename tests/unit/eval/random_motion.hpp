// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "geometry/se3.hpp"

namespace hallway::eval {

inline Vec3 random_point(const Random& random, std::uint32_t step, double spread_m) {
  return {random.uniform(step, 0, -spread_m, spread_m), random.uniform(step, 1, -spread_m, spread_m),
          random.uniform(step, 2, -spread_m, spread_m)};
}

inline std::vector<Vec3> random_points(std::uint32_t count, std::uint64_t seed) {
  const Random random(seed, stream_id("test.points"));
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i < count; ++i) points.push_back(random_point(random, i, 50.0));
  return points;
}

/// A uniformly distributed rotation and a shift of up to 100 m on each axis.
inline Pose random_motion(std::uint64_t seed, std::uint32_t step = 0) {
  const Random random(seed, stream_id("test.motion"));
  const Quat q(random.normal(step, 3), random.normal(step, 4), random.normal(step, 5),
               random.normal(step, 6));
  return {q.normalized(), random_point(random, step, 100.0)};
}

}  // namespace hallway::eval
