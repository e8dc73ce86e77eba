// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "geometry/se3.hpp"

/// Points, and what a loop over all of them says of their distances.
namespace hallway::test {

/// A place of the box from -6, -5, -2.5 to 6, 5, 2.5.
inline Vec3 somewhere(std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  const double x = share(random), y = share(random);
  return {6.0 * x, 5.0 * y, 2.5 * share(random)};
}

/// Scattered points, points of a lattice (many ties) and copies.
inline std::vector<Vec3> mixed_points(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto below = [&random](std::uint64_t count) { return static_cast<double>(random() % count); };
  std::vector<Vec3> points;
  for (int i = 0; i < 300; ++i) points.push_back(somewhere(random));
  for (int i = 0; i < 300; ++i) {
    const double x = below(6), y = below(6);
    points.emplace_back(x, y, below(3));
  }
  return points;
}

/// Squared distances of all points from a place, rising.
inline std::vector<double> all_distances2(const std::vector<Vec3>& points, const Vec3& place) {
  std::vector<double> distances;
  for (const Vec3& p : points) distances.push_back((p - place).squaredNorm());
  std::sort(distances.begin(), distances.end());
  return distances;
}

}  // namespace hallway::test
