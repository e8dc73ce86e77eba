// SPDX-License-Identifier: MIT
#include "icp/core/cloud_scale.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "geometry/median.hpp"

namespace hallway::icp {
namespace {

constexpr std::size_t kNear = 8;  // fewer than so many copies of a point do not hide the next one

using Cube = std::array<double, 3>;

Cube cube_of(const Vec3& p, double cube_m) {
  return {std::floor(p.x() / cube_m), std::floor(p.y() / cube_m), std::floor(p.z() / cube_m)};
}

/// A number that looks random and follows from the coordinates.
std::uint64_t hash_of(const Vec3& p) {
  std::uint64_t h = 0;
  for (const double coordinate : p) {
    h = (h ^ std::bit_cast<std::uint64_t>(coordinate)) * 0x9e3779b97f4a7c15u;
    h ^= h >> 29;
  }
  return h;
}

}  // namespace

double spacing_of(const Points& places, const KdTree& tree) {
  std::vector<double> distances;
  std::vector<Neighbour> near;
  for (const Vec3& p : places) {
    tree.nearest(p, kNear, near);
    const auto other =
        std::find_if(near.begin(), near.end(), [](const Neighbour& each) { return each.distance2 > 0.0; });
    if (other != near.end()) distances.push_back(std::sqrt(other->distance2));
  }
  return distances.empty() ? 0.0 : median(distances);
}

double extent_of(const Points& points) {
  if (points.empty()) return 0.0;
  const Vec3 middle = median_of_coordinates(points);
  std::vector<double> values(points.size());
  std::transform(points.begin(), points.end(), values.begin(),
                 [&middle](const Vec3& p) { return (p - middle).norm(); });
  return 2.0 * median(values);
}

Points thinned(const Points& points, double cube_m) {
  struct Placed {
    Cube cube;
    Vec3 point;
  };
  std::vector<Placed> placed;
  placed.reserve(points.size());
  for (const Vec3& p : points) placed.push_back({cube_of(p, cube_m), p});
  const auto key = [](const Placed& each) {
    return std::tuple(each.cube, each.point.x(), each.point.y(), each.point.z());
  };
  std::sort(placed.begin(), placed.end(), [&](const Placed& a, const Placed& b) { return key(a) < key(b); });
  Points means;
  for (std::size_t begin = 0, end = 0; begin < placed.size(); begin = end) {
    // About the first, so that places far from the origin lose no digits.
    Vec3 sum = Vec3::Zero();
    for (; end < placed.size() && placed[end].cube == placed[begin].cube; ++end)
      sum += placed[end].point - placed[begin].point;
    means.push_back(placed[begin].point + sum / static_cast<double>(end - begin));
  }
  return means;
}

Points sampled(const Points& points, std::size_t most) {
  if (points.size() <= most) return points;
  Points chosen = points;
  std::sort(chosen.begin(), chosen.end(),
            [](const Vec3& a, const Vec3& b) { return hash_of(a) < hash_of(b); });
  chosen.resize(most);
  return chosen;
}

}  // namespace hallway::icp
