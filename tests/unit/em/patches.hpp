// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "em/core/types.hpp"

namespace hallway::em::planted {

/// Random numbers one after the other.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(seed, stream_id("em.test")) {}
  double between(double low, double high) { return random_.uniform(0, next_++, low, high); }
  double normal() { return random_.normal(1, next_++); }
  std::uint64_t below(std::uint64_t bound) {
    return static_cast<std::uint64_t>(between(0.0, static_cast<double>(bound)));
  }

 private:
  Random random_;
  std::uint64_t next_ = 0;
};

/// A rectangle with noisy points on it.
struct Patch {
  Vec3 centre = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
  Vec3 axis_u = Vec3::UnitX();
  double half_u = 1.0;
  double half_v = 1.0;
  std::size_t points = 500;
  double sigma = 0.01;
};

inline Vec3 random_direction(Numbers& numbers) {
  Vec3 v(numbers.normal(), numbers.normal(), numbers.normal());
  while (v.norm() < 0.1) v = Vec3(numbers.normal(), numbers.normal(), numbers.normal());
  return v.normalized();
}

inline Patch random_patch(std::uint64_t seed) {
  Numbers numbers(seed);
  Patch patch;
  patch.centre = Vec3(numbers.between(-5, 5), numbers.between(-5, 5), numbers.between(-5, 5));
  patch.normal = random_direction(numbers);
  patch.axis_u = patch.normal.cross(random_direction(numbers)).normalized();
  patch.half_u = numbers.between(0.5, 2.0);
  patch.half_v = numbers.between(0.5, 2.0);
  return patch;
}

/// Points uniform on the patch, with the same noise along each axis of space.
inline std::vector<Vec3> cloud_of(const Patch& patch, std::uint64_t seed) {
  Numbers numbers(seed + 1000003);
  const Vec3 axis_v = patch.normal.cross(patch.axis_u);
  std::vector<Vec3> cloud;
  for (std::size_t i = 0; i < patch.points; ++i) {
    const double u = numbers.between(-patch.half_u, patch.half_u);
    const double v = numbers.between(-patch.half_v, patch.half_v);
    const Vec3 noise(numbers.normal(), numbers.normal(), numbers.normal());
    cloud.push_back(patch.centre + u * patch.axis_u + v * axis_v + patch.sigma * noise);
  }
  return cloud;
}

}  // namespace hallway::em::planted
