// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/resize.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::slam_plane::thesis {

Vec2 middle_shift(const Vec2& direction, KeyPoint key, double from_size, double to_size) {
  if (key == KeyPoint::none) return Vec2::Zero();
  const double half = 0.5 * (to_size - from_size);
  return (key == KeyPoint::left ? half : -half) * direction;
}

std::optional<Placement> resized(const Placement& placement, double size, double tolerance) {
  if (placement.key == KeyPoint::none) {
    if (std::abs(size - placement.size) > tolerance) return std::nullopt;
    return placement;
  }
  Placement result = placement;
  result.middle += middle_shift(placement.direction, placement.key, placement.size, size);
  result.size = size;
  return result;
}

std::optional<Segment> resized(const Segment& segment, KeyPoint key, double size, double tolerance) {
  const Placement placement{segment.middle(), segment.direction(), segment.length(), key, {}, true};
  const auto result = resized(placement, size, tolerance);
  if (!result) return std::nullopt;
  return result->segment();
}

bool bring_to_one_size(Placement& a, Placement& b, double tolerance) {
  Placement& smaller = a.size < b.size ? a : b;
  const auto grown = resized(smaller, std::max(a.size, b.size), tolerance);
  if (grown) smaller = *grown;
  return grown.has_value();
}

Placement chained(Placement& base, const Comparison& comparison, double tolerance) {
  if (!base.valid || !comparison.valid) return {};
  Placement parent = comparison.placement(0);
  if (!bring_to_one_size(base, parent, tolerance)) return {};
  const Pose2 T_base_turned{Vec2::Zero(), base.direction};
  Placement child = comparison.placement(1);
  child.middle = base.middle + T_base_turned.rotate(child.middle - parent.middle);
  child.direction = T_base_turned.rotate(child.direction).normalized();
  return child;
}

}  // namespace hallway::slam_plane::thesis
