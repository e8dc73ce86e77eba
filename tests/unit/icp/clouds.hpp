// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>
#include <random>

#include "icp/core/types.hpp"

/// Made-up clouds and motions.
namespace hallway::icp::clouds {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInf = std::numeric_limits<double>::infinity();

/// Random numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  /// About normal: the sum of twelve.
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += uniform(0.0, 1.0);
    return sum;
  }
  Vec3 in_box(const Vec3& half) {
    return {uniform(-half.x(), half.x()), uniform(-half.y(), half.y()), uniform(-half.z(), half.z())};
  }
  Vec3 noise(double sigma_m) { return {sigma_m * normal(), sigma_m * normal(), sigma_m * normal()}; }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }

 private:
  std::mt19937_64 engine_;
};

/// Points scattered in a room of 20 x 16 x 6 m.
inline Points scattered(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Points points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(random.in_box({10, 8, 3}));
  return points;
}

/// Points on the floor, two walls and a box in a corner: surfaces that fix a motion. Each seed gives other points of the same surfaces.
inline Points corner(std::size_t count, std::uint64_t seed, double noise_m = 0.0) {
  Random random(seed);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = random.uniform(0, 6), v = random.uniform(0, 5), w = random.uniform(0, 2.5);
    Vec3 p;
    switch (i % 5) {
      case 0:
        p = {u, v, 0};
        break;
      case 1:
        p = {u, 0, w};
        break;
      case 2:
        p = {0, v, w};
        break;
      case 3:
        p = {2, 0.2 * v, 0.4 * w};
        break;
      default:
        p = {u / 3, 1, 0.4 * w};
        break;
    }
    points.push_back(p + random.noise(noise_m));
  }
  return points;
}

inline Pose pose(const Vec3& t, double yaw, double pitch = 0.0, double roll = 0.0) {
  return {Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch, Vec3::UnitY()) *
              Eigen::AngleAxisd(roll, Vec3::UnitX()),
          t};
}

inline Points moved(const Pose& T, const Points& points) {
  Points result;
  for (const Vec3& p : points) result.push_back(T * p);
  return result;
}

inline Points shuffled(Points points, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random.below(i)]);
  return points;
}

/// How far apart two poses put a place 10 m away [m].
inline double gap(const Pose& a, const Pose& b) {
  const Pose between = a.inverse() * b;
  return between.t.norm() + 10.0 * angle_of(between.q);
}

}  // namespace hallway::icp::clouds
