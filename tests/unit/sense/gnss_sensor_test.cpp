// SPDX-License-Identifier: MIT
#include "sense/gnss_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "sense/standing_body.hpp"
#include "support/errors.hpp"
#include "unit/sense/moving_sensor.hpp"

namespace hallway::sense {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

GnssSpec plain_gnss() {
  GnssSpec spec;
  spec.name = "gnss";
  spec.T_body_sensor.t = {0.1, 0.2, 0.3};
  return spec;
}

/// A cube about a point.
GnssZone cube(const Vec3& middle, double half, double factor) {
  GnssZone zone;
  zone.factor = factor;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const Vec3 normal = sign * Vec3::Unit(axis);
      zone.planes.push_back({normal, normal.dot(middle) + half});
    }
  }
  return zone;
}

struct Fix {
  GnssReading reading;
  GnssTruth truth;
};

Fix fix_of(const GnssSensor& sensor, const Pose& pose, std::uint32_t number = 0) {
  Fix made;
  sensor.read(number, 0, sense::StandingBody(pose), made.reading, made.truth);
  return made;
}

TEST(GnssSensor, IsWhereItsAntennaIs) {
  const Pose pose{from_yaw_pitch_roll(1.0, 0.2, -0.3), Vec3(5, -7, 2)};
  const Fix fix = fix_of(GnssSensor(plain_gnss(), kSecond_ns, 1), pose);
  EXPECT_EQ(fix.reading.fix, GnssFix::kPosition);
  EXPECT_LT((fix.reading.position - pose * Vec3(0.1, 0.2, 0.3)).norm(), 1e-12);
}

TEST(GnssSensor, ItsFrameIsEastNorthUp) {
  GnssSpec spec = plain_gnss();
  spec.T_body_sensor.t.setZero();
  spec.north_rad =
      0.0;  // the world's x axis points north: what is ahead is north, what is to the left is west
  const Fix fix = fix_of(GnssSensor(spec, kSecond_ns, 1), Pose{Quat::Identity(), Vec3(2, 3, 4)});
  EXPECT_LT((fix.reading.position - Vec3(-3, 2, 4)).norm(), 1e-12);
  EXPECT_EQ(fix.truth.position, Vec3(2, 3, 4));
}

TEST(GnssSensor, ErrorsAreAsDeclared) {
  GnssSpec spec = plain_gnss();
  spec.T_body_sensor.t.setZero();
  spec.level = {.noise_m = 0.4, .correlated_m = 1.5};
  spec.height = {.noise_m = 0.8, .correlated_m = 2.5};
  spec.correlation_s = 3.0;
  spec.timing.rate_hz = 10.0;
  const GnssSensor sensor(spec, kSecond_ns, 5);
  constexpr std::uint32_t kFixes = 1'000'000;
  const double r = std::exp(-0.1 / 3.0);  // from fix to fix
  /// Sums over the fixes, by axis: of the independent part, of what is new in the correlated part, and of that times what came before.
  struct Sums {
    Vec3 noise = Vec3::Zero(), noise2 = Vec3::Zero();
    Vec3 fresh = Vec3::Zero(), fresh2 = Vec3::Zero(), fresh_before = Vec3::Zero();
    Vec3 noise_before = Vec3::Zero(), noise_next = Vec3::Zero();
  } sums;
  Vec3 correlated_before = Vec3::Zero(), noise_before = Vec3::Zero();
  for (std::uint32_t k = 0; k < kFixes; ++k) {
    const Fix fix = fix_of(sensor, Pose(), k);
    const Vec3 noise = fix.reading.position - fix.truth.correlated;
    sums.noise += noise;
    sums.noise2 += noise.cwiseAbs2();
    sums.noise_before += noise.cwiseProduct(noise_before);
    sums.noise_next += noise.cwiseProduct(Vec3(noise.y(), noise.z(), noise.x()));
    if (k > 0) {
      const Vec3 fresh = fix.truth.correlated - r * correlated_before;
      sums.fresh += fresh;
      sums.fresh2 += fresh.cwiseAbs2();
      sums.fresh_before += fresh.cwiseProduct(correlated_before);
    }
    correlated_before = fix.truth.correlated;
    noise_before = noise;
  }
  const Fix first = fix_of(sensor, Pose(), 0);
  EXPECT_DOUBLE_EQ(first.reading.covariance[0], 0.4 * 0.4 + 1.5 * 1.5);
  EXPECT_DOUBLE_EQ(first.reading.covariance[5], 0.8 * 0.8 + 2.5 * 2.5);
  EXPECT_EQ(first.reading.covariance[1], 0.0);
  const double errors =
      3.0 / std::sqrt(static_cast<double>(kFixes));  // three standard errors of a unit deviate's mean
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const GnssError& error = axis == 2 ? spec.height : spec.level;
    const GnssError& next = axis == 1 ? spec.height : spec.level;
    const double noise2 = error.noise_m * error.noise_m, slow = error.correlated_m;
    const double fresh2 = slow * slow * (1.0 - r * r);  // of another correlation time, others
    EXPECT_NEAR(sums.noise(axis) / kFixes, 0.0, errors * error.noise_m) << axis;
    EXPECT_NEAR(sums.noise2(axis) / kFixes, noise2, errors * std::sqrt(2.0) * noise2) << axis;
    EXPECT_NEAR(sums.noise_before(axis) / kFixes, 0.0, errors * noise2) << axis;
    EXPECT_NEAR(sums.noise_next(axis) / kFixes, 0.0, errors * error.noise_m * next.noise_m) << axis;
    EXPECT_NEAR(sums.fresh(axis) / kFixes, 0.0, errors * std::sqrt(fresh2)) << axis;
    EXPECT_NEAR(sums.fresh2(axis) / kFixes, fresh2, errors * std::sqrt(2.0) * fresh2) << axis;
    EXPECT_NEAR(sums.fresh_before(axis) / kFixes, 0.0, errors * std::sqrt(fresh2) * slow) << axis;
  }
}

TEST(GnssSensor, ZonesWorsenOrTakeTheFix) {
  GnssSpec spec = plain_gnss();
  spec.T_body_sensor.t.setZero();
  spec.level.noise_m = 1.0;
  const GnssSensor open(spec, kSecond_ns, 5);
  spec.zones = {cube({10, 0, 0}, 2.0, 4.0), cube({11, 0, 0}, 2.0, 2.0), cube({20, 0, 0}, 2.0, 0.0),
                cube({21, 0, 0}, 3.0, 2.0)};
  const GnssSensor sensor(spec, kSecond_ns, 5);
  const auto at = [](double x) { return Pose{Quat::Identity(), Vec3(x, 0, 0)}; };
  EXPECT_EQ(fix_of(sensor, at(0)).reading.position, fix_of(open, at(0)).reading.position);
  const double error = fix_of(open, at(0)).reading.position.y();
  EXPECT_DOUBLE_EQ(fix_of(sensor, at(10)).reading.position.y(), 4.0 * error);    // the worse of two
  EXPECT_DOUBLE_EQ(fix_of(sensor, at(12.5)).reading.position.y(), 2.0 * error);  // the other one alone
  EXPECT_DOUBLE_EQ(fix_of(sensor, at(10)).reading.covariance[0], 16.0);
  const Fix none = fix_of(sensor, at(20));
  EXPECT_EQ(none.reading.fix, GnssFix::kNone);
  EXPECT_TRUE(none.reading.position.array().isNaN().all());
  EXPECT_EQ(none.truth.position, Vec3(20, 0, 0));
  EXPECT_EQ(fix_of(sensor, at(23)).reading.fix, GnssFix::kPosition);
}

TEST(GnssSensor, WhatIsOutOfRangeIsRefusedByItsName) {
  const auto refusal = [&](const std::function<void(GnssSpec&)>& change) {
    GnssSpec spec = plain_gnss();
    change(spec);
    const std::optional<Error> error = test::error_of([&] { GnssSensor(spec, kSecond_ns, 1); });
    return error ? error->message().substr(0, error->message().find(' ')) : std::string("accepted");
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal([](GnssSpec&) {}), "accepted");
  EXPECT_EQ(refusal([](GnssSpec& s) { s.name.clear(); }), "name");
  EXPECT_EQ(refusal([&](GnssSpec& s) { s.T_body_sensor.t.z() = nan; }), "T_body_sensor");
  EXPECT_EQ(refusal([](GnssSpec& s) { s.level.noise_m = -1.0; }), "level.noise_m");
  EXPECT_EQ(refusal([&](GnssSpec& s) { s.height.correlated_m = nan; }), "height.correlated_m");
  EXPECT_EQ(refusal([](GnssSpec& s) { s.correlation_s = -1.0; }), "correlation_s");
  EXPECT_EQ(refusal([](GnssSpec& s) { s.zones = {cube({0, 0, 0}, 1, 0.5)}; }), "zones.factor");
  EXPECT_EQ(refusal([](GnssSpec& s) { s.zones = {GnssZone()}; }), "zones");
}

}  // namespace
}  // namespace hallway::sense
