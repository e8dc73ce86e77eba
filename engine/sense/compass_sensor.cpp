// SPDX-License-Identifier: MIT
#include "sense/compass_sensor.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "sense/spec_check.hpp"

namespace hallway::sense {
namespace {

constexpr double kUpright = 1e-6;  ///< less of an axis, or of the field, is level than tells a direction

// Steps of the stream: what the numbers are for.
namespace compass_use {
enum Use : std::uint32_t { kNoise, kBias };
}

double wrapped(double radians) {
  const double angle = std::remainder(radians, 2.0 * std::numbers::pi);
  return angle <= -std::numbers::pi ? std::numbers::pi : angle;
}

void check(const CompassSpec& spec) {
  const SpecCheck check(spec.name);
  check.mount(spec.T_body_sensor);
  if (!std::isfinite(spec.north_rad)) check.fail("north_rad", "is not finite");
  check.not_negative("noise_rad", spec.noise_rad);
  check.not_negative("bias_sigma_rad", spec.bias_sigma_rad);
  for (const Magnet& magnet : spec.magnets) {
    if (!magnet.position.allFinite()) check.fail("magnets", "has one whose position is not finite");
    check.positive("magnets.reach_m", magnet.reach_m);
    if (!std::isfinite(magnet.strength)) check.fail("magnets.strength", "is not finite");
  }
}

}  // namespace

Vec2 level_field(double north_rad, const std::vector<Magnet>& magnets, const Vec3& point) {
  Vec2 field(std::cos(north_rad), std::sin(north_rad));
  for (const Magnet& magnet : magnets) {
    const Vec3 away = point - magnet.position;
    const double far = away.norm() / magnet.reach_m;
    const double level = away.head<2>().norm();
    if (far >= 1.0 || level <= kUpright * magnet.reach_m) continue;
    const double left = 1.0 - far * far;
    field += magnet.strength * left * left / level * away.head<2>();
  }
  return field;
}

CompassSensor::CompassSensor(CompassSpec spec, std::uint64_t seed)
    : spec_((check(spec), std::move(spec))),
      random_(seed, stream_id("sensor.compass." + spec_.name)),
      bias_rad_(spec_.bias_sigma_rad * random_.normal(compass_use::kBias, 0)) {}

void CompassSensor::read(std::uint32_t number, std::int64_t t_ns, const Trajectory& trajectory,
                         CompassReading& reading, CompassTruth& truth) const {
  const Pose T_world_sensor = trajectory.pose_at(t_ns) * spec_.T_body_sensor;
  check_pose(spec_.name, number, T_world_sensor);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const Vec3 axis = T_world_sensor.q * Vec3::UnitX();
  const Vec2 field = level_field(spec_.north_rad, spec_.magnets, T_world_sensor.t);
  const bool is_upright = axis.head<2>().norm() < kUpright;
  const bool has_field = field.norm() >= kUpright;
  const double yaw = std::atan2(axis.y(), axis.x());
  truth.heading_rad = is_upright ? kNone : wrapped(yaw - spec_.north_rad);
  truth.deviation_rad = has_field ? wrapped(std::atan2(field.y(), field.x()) - spec_.north_rad) : kNone;
  truth.bias_rad = bias_rad_;
  reading.variance_rad2 = spec_.noise_rad * spec_.noise_rad + spec_.bias_sigma_rad * spec_.bias_sigma_rad;
  reading.heading_rad = wrapped(truth.heading_rad - truth.deviation_rad + bias_rad_ +
                                spec_.noise_rad * random_.normal(compass_use::kNoise, number));
}

}  // namespace hallway::sense
