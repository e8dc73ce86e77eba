// SPDX-License-Identifier: MIT
#include "icp/core/overlapping_grid.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::icp {
namespace {

constexpr double kMostCubes = 1e18;  // far places share the last cube instead of overflowing

}  // namespace

std::size_t OverlappingGrid::Hash::operator()(const Cube& cube) const {
  std::uint64_t h = 0;
  for (const std::int64_t part : cube) {
    h = (h ^ static_cast<std::uint64_t>(part)) * 0x9e3779b97f4a7c15u;
    h ^= h >> 29;
  }
  return static_cast<std::size_t>(h);
}

OverlappingGrid::Cube OverlappingGrid::cube_of(const Vec3& p) const {
  Cube cube{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double scaled = std::floor(p[static_cast<Eigen::Index>(axis)] / edge_m_);
    cube[axis] = static_cast<std::int64_t>(std::clamp(scaled, -kMostCubes, kMostCubes));
  }
  return cube;
}

void OverlappingGrid::add(const Vec3& p) {
  const auto number = static_cast<std::uint32_t>(points_.size());
  points_.push_back(p);
  // A little more than reach_m, so that rounding puts no point that is asked for outside.
  const Vec3 margin = Vec3::Constant(reach_m_ * (1.0 + 1e-9));
  const Cube low = cube_of(p - margin), high = cube_of(p + margin);
  for (std::int64_t x = low[0]; x <= high[0]; ++x) {
    for (std::int64_t y = low[1]; y <= high[1]; ++y) {
      for (std::int64_t z = low[2]; z <= high[2]; ++z) cubes_[{x, y, z}].push_back(number);
    }
  }
}

std::optional<std::uint32_t> OverlappingGrid::nearest(const Vec3& place) const {
  const auto cube = cubes_.find(cube_of(place));
  if (cube == cubes_.end()) return std::nullopt;
  std::optional<std::uint32_t> best;
  double best2 = reach_m_ * reach_m_;
  for (const std::uint32_t number : cube->second) {
    const double distance2 = (points_[number] - place).squaredNorm();
    if (best ? distance2 >= best2 : distance2 > best2) continue;
    best = number;
    best2 = distance2;
  }
  return best;
}

}  // namespace hallway::icp
