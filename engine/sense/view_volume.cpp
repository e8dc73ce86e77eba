// SPDX-License-Identifier: MIT
#include "sense/view_volume.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::sense {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;

/// Far more than rounding, of the distances that a test works with.
constexpr double kSlack = 1e-9;

}  // namespace

ViewVolume::ViewVolume(const FieldOfView& field_of_view, const Pose& T_world_sensor)
    : eye_(T_world_sensor.t),
      up_(T_world_sensor.q * Vec3::UnitZ()),
      min_range_m_(field_of_view.min_range_m()),
      max_range_m_(field_of_view.max_range_m()) {
  const auto add = [&](const Vec3& inward) { inward_.push_back(T_world_sensor.q * inward); };
  if (field_of_view.horizontal() < kHalfTurn) {
    const double half = 0.5 * field_of_view.horizontal();
    add({std::sin(half), std::cos(half), 0.0});
    add({std::sin(half), -std::cos(half), 0.0});
  }
  if (field_of_view.vertical() >= kHalfTurn) return;
  const double half = 0.5 * field_of_view.vertical();
  if (field_of_view.is_pyramid()) {
    add({std::sin(half), 0.0, std::cos(half)});
    add({std::sin(half), 0.0, -std::cos(half)});
  } else {
    band_ = true;
    sin_elevation_ = std::sin(half);
    cos_elevation_ = std::cos(half);
  }
}

bool ViewVolume::may_contain(const Box& box) const {
  const Vec3 centre = Vec3(box.center()) - eye_;
  const Vec3 half_size = 0.5 * box.sizes();
  const double radius_m = half_size.norm();
  const double slack_m = kSlack * (centre.norm() + radius_m + eye_.norm());
  if (!within_range(box, slack_m)) return false;
  for (const Vec3& inward : inward_) {
    if (inward.dot(centre) + inward.cwiseAbs().dot(half_size) < -slack_m) return false;
  }
  return !band_ || within_elevation(centre, radius_m + slack_m);
}

bool ViewVolume::within_range(const Box& box, double slack_m) const {
  const Vec3 low = box.min() - eye_;
  const Vec3 high = box.max() - eye_;
  const Vec3 nearest = low.cwiseMax(Vec3::Zero()) + high.cwiseMin(Vec3::Zero());
  const Vec3 farthest = low.cwiseAbs().cwiseMax(high.cwiseAbs());
  return nearest.norm() <= max_range_m_ + slack_m && farthest.norm() >= min_range_m_ - slack_m;
}

/// How far a point is beyond the cone grows by no more than the way that the point moves.
bool ViewVolume::within_elevation(const Vec3& centre, double radius_m) const {
  const double height = up_.dot(centre);
  const double level = (centre - height * up_).norm();
  return std::abs(height) * cos_elevation_ - level * sin_elevation_ <= radius_m;
}

}  // namespace hallway::sense
