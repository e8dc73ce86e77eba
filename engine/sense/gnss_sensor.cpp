// SPDX-License-Identifier: MIT
#include "sense/gnss_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "sense/spec_check.hpp"

namespace hallway::sense {
namespace {

// Steps of the stream: what the numbers are for.
namespace gnss_use {
enum Use : std::uint32_t { kNoise, kCorrelatedX, kCorrelatedY, kCorrelatedZ };
}

GaussMarkov correlated(const GnssSpec& spec, const Random& random, gnss_use::Use axis,
                       std::int64_t period_ns) {
  const double interval_s = static_cast<double>(interval_ns(spec.timing, period_ns)) * 1e-9;
  const GnssError& error = axis == gnss_use::kCorrelatedZ ? spec.height : spec.level;
  return {random, axis, error.correlated_m, spec.correlation_s, interval_s};
}

void check(const GnssSpec& spec) {
  const SpecCheck check(spec.name);
  check.mount(spec.T_body_sensor);
  if (!std::isfinite(spec.north_rad)) check.fail("north_rad", "is not finite");
  check.not_negative("level.noise_m", spec.level.noise_m);
  check.not_negative("level.correlated_m", spec.level.correlated_m);
  check.not_negative("height.noise_m", spec.height.noise_m);
  check.not_negative("height.correlated_m", spec.height.correlated_m);
  check.not_negative("correlation_s", spec.correlation_s);
  for (const GnssZone& zone : spec.zones) {
    if (zone.planes.size() < 4) check.fail("zones", "has one that no four planes bound");
    if (zone.factor != 0.0) check.within("zones.factor", zone.factor, 1.0, 1e6);
  }
}

}  // namespace

GnssSensor::GnssSensor(GnssSpec spec, std::int64_t period_ns, std::uint64_t seed)
    : spec_((check(spec), std::move(spec))),
      random_(seed, stream_id("sensor.gnss." + spec_.name)),
      q_enu_world_(Eigen::AngleAxisd(0.5 * std::numbers::pi - spec_.north_rad, Vec3::UnitZ())),
      correlated_{correlated(spec_, random_, gnss_use::kCorrelatedX, period_ns),
                  correlated(spec_, random_, gnss_use::kCorrelatedY, period_ns),
                  correlated(spec_, random_, gnss_use::kCorrelatedZ, period_ns)} {}

/// 0: no fix.
double GnssSensor::factor_at(const Vec3& position) const {
  double factor = 1.0;
  for (const GnssZone& zone : spec_.zones) {
    const bool within =
        std::ranges::all_of(zone.planes, [&](const Plane& plane) { return plane.distance(position) <= 0.0; });
    if (!within) continue;
    if (zone.factor == 0.0) return 0.0;
    factor = std::max(factor, zone.factor);
  }
  return factor;
}

void GnssSensor::read(std::uint32_t number, std::int64_t t_ns, const Trajectory& trajectory,
                      GnssReading& reading, GnssTruth& truth) const {
  const Pose T_world_body = trajectory.pose_at(t_ns);
  check_pose(spec_.name, number, T_world_body);
  truth.position = T_world_body * spec_.T_body_sensor.t;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    truth.correlated(axis) = correlated_.at(static_cast<std::size_t>(axis)).value(number);

  const double factor = factor_at(truth.position);
  if (factor == 0.0) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    reading.fix = GnssFix::kNone;
    reading.position.setConstant(kNone);
    reading.covariance.fill(kNone);
    return;
  }
  reading.fix = GnssFix::kPosition;
  const Vec3 from_origin = q_enu_world_ * truth.position;
  reading.covariance.fill(0.0);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const GnssError& error = axis == 2 ? spec_.height : spec_.level;
    const double white =
        error.noise_m *
        random_.normal(gnss_use::kNoise, std::uint64_t{number} * 3 + static_cast<std::uint64_t>(axis));
    reading.position(axis) = from_origin(axis) + factor * (truth.correlated(axis) + white);
    constexpr std::array<std::size_t, 3> kDiagonal{0, 3, 5};
    reading.covariance.at(kDiagonal.at(static_cast<std::size_t>(axis))) =
        factor * factor * (error.noise_m * error.noise_m + error.correlated_m * error.correlated_m);
  }
}

}  // namespace hallway::sense
