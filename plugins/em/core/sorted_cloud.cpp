// SPDX-License-Identifier: MIT
#include "em/core/sorted_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "geometry/median.hpp"

namespace hallway::em {
namespace {

constexpr double kLargest = 1e100;  // squares of coordinates must be finite

bool usable(const Vec3& p) {
  return std::abs(p.x()) <= kLargest && std::abs(p.y()) <= kLargest && std::abs(p.z()) <= kLargest;
}

bool lies_before(const Vec3& a, const Vec3& b) {
  return std::make_tuple(a.x(), a.y(), a.z()) < std::make_tuple(b.x(), b.y(), b.z());
}

}  // namespace

SortedCloud sort_cloud(std::span<const Vec3> cloud) {
  std::vector<std::uint32_t> order;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (usable(cloud[i])) order.push_back(static_cast<std::uint32_t>(i));
  }
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return lies_before(cloud[a], cloud[b]); });
  SortedCloud sorted;
  sorted.place_of.assign(cloud.size(), kNoPlane);
  for (const std::uint32_t i : order) {
    if (sorted.points.empty() || sorted.points.back() != cloud[i]) sorted.points.push_back(cloud[i]);
    sorted.place_of[i] = static_cast<std::uint32_t>(sorted.points.size() - 1);
  }
  if (sorted.points.empty()) return sorted;
  sorted.origin = median_of_coordinates(sorted.points);
  for (Vec3& p : sorted.points) p -= sorted.origin;
  return sorted;
}

}  // namespace hallway::em
