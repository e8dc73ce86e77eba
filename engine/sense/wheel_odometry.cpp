// SPDX-License-Identifier: MIT
#include "sense/wheel_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/symmetric.hpp"
#include "sense/spec_check.hpp"

namespace hallway::sense {
namespace {

const WheelOdometrySpec& checked_odometry(const WheelOdometrySpec& spec) {
  const SpecCheck check(spec.name);
  for (const OdometryWheel& wheel : spec.wheels) {
    if (!wheel.position_m.allFinite()) check.fail("wheels", "has a position that is not finite");
    if (!wheel.rolling.allFinite() || !(wheel.rolling.norm() > 0.0))
      check.fail("wheels", "has a rolling direction that is zero or not finite");
  }
  check.within("turn_share", spec.turn_share, 0.0, 1.0);
  check.positive("turn_share", spec.turn_share);
  check.within("radius_sigma", spec.radius_sigma, 0.0, 0.5);
  check.not_negative("slip", spec.slip);
  check.not_negative("side_slip", spec.side_slip);
  check.not_negative("off_plane.height_m", spec.off_plane.height_m);
  check.not_negative("off_plane.tilt_rad", spec.off_plane.tilt_rad);
  return spec;
}

/// The velocity along `direction` of a place of the body, as a row over the twist.
Vec3 velocity_row(const Vec2& place, const Vec2& direction) {
  return {direction.x(), direction.y(), place.x() * direction.y() - place.y() * direction.x()};
}

/// The twist for a metre of each rim: columns of the pseudo-inverse.
std::vector<Vec3> wheel_gains(const WheelOdometrySpec& spec) {
  // Rotation in units of the largest distance of a wheel, so that lengths do not matter to the rank.
  double scale = 0.0;
  for (const OdometryWheel& wheel : spec.wheels) scale = std::max(scale, wheel.position_m.norm());
  if (scale == 0.0) scale = 1.0;
  std::vector<Vec3> rows;
  Mat3 normal = Mat3::Zero();
  for (const OdometryWheel& wheel : spec.wheels) {
    rows.push_back(velocity_row(wheel.position_m / scale, wheel.rolling));
    normal += rows.back() * rows.back().transpose();
    if (!wheel.holds_sideways) continue;
    const Vec2 sideways = Vec2(-wheel.rolling.y(), wheel.rolling.x()).normalized();
    const Vec3 held = velocity_row(wheel.position_m / scale, sideways);
    normal += held * held.transpose();
  }
  const Vec3 values = spectrum<3>(normal).values;
  const bool is_determined = values.allFinite() && values[0] > 1e-10 * values[2];
  if (!is_determined)
    SpecCheck(spec.name).fail("wheels", "do not determine the motion of the body in the plane");
  const Mat3 inverse = inverse_of_positive<3>(normal).matrix;
  for (Vec3& row : rows) {
    row = inverse * row;
    row.z() *= spec.turn_share / scale;
  }
  return rows;
}

/// Counts at the ends of their range are differences of doubles, since they may be too far apart for an integer.
double tick_difference(std::int64_t before, std::int64_t after) {
  std::int64_t difference = 0;
  if (!__builtin_sub_overflow(after, before, &difference)) return static_cast<double>(difference);
  return static_cast<double>(after) - static_cast<double>(before);
}

}  // namespace

std::vector<OdometryWheel> two_odometry_wheels(double wheel_base_m) {
  const double half = 0.5 * wheel_base_m;
  return {{.position_m = {0.0, half}}, {.position_m = {0.0, -half}}};
}

std::vector<OdometryWheel> mecanum_odometry_wheels(double wheel_base_m, double axle_distance_m) {
  const double y = 0.5 * wheel_base_m, x = 0.5 * axle_distance_m;
  return {{.position_m = {x, y}, .rolling = {1.0, -1.0}, .holds_sideways = false},
          {.position_m = {x, -y}, .rolling = {1.0, 1.0}, .holds_sideways = false},
          {.position_m = {-x, y}, .rolling = {1.0, 1.0}, .holds_sideways = false},
          {.position_m = {-x, -y}, .rolling = {1.0, -1.0}, .holds_sideways = false}};
}

WheelOdometry::WheelOdometry(WheelOdometrySpec spec, std::uint64_t seed)
    : spec_(std::move(spec)),
      encoder_(checked_odometry(spec_).encoder, spec_.wheels.size(), seed),
      gains_(wheel_gains(spec_)) {}

PlanarStep WheelOdometry::step(std::span<const std::int64_t> before,
                               std::span<const std::int64_t> after) const {
  if (before.size() != gains_.size() || after.size() != gains_.size())
    SpecCheck(spec_.name).fail("wheels", "are not as many as the counts");
  const double tick_m = spec_.encoder.nominal_m_per_tick();
  PlanarStep step;
  for (std::size_t i = 0; i < gains_.size(); ++i) {
    const double way = tick_m * tick_difference(before[i], after[i]);
    const double radius = spec_.radius_sigma * way;
    const double variance = tick_m * tick_m / 6.0 + radius * radius + spec_.slip * spec_.slip * std::abs(way);
    step.twist += way * gains_[i];
    step.covariance += variance * gains_[i] * gains_[i].transpose();
  }
  step.covariance(1, 1) += spec_.side_slip * spec_.side_slip * step.twist.head<2>().norm();
  return step;
}

}  // namespace hallway::sense
