// SPDX-License-Identifier: MIT
#include "sense/wheel_odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "base/error.hpp"
#include "drive/wheels.hpp"
#include "support/long_mode.hpp"

namespace hallway::sense {
namespace {

constexpr double kBase_m = 0.32, kAxles_m = 0.26;

WheelOdometrySpec wheels_spec(std::vector<OdometryWheel> wheels) {
  return {.name = "odometry",
          .encoder = {.name = "wheels", .ticks_per_revolution = 2048.0, .wheel_radius_m = 0.05},
          .wheels = std::move(wheels)};
}

/// The covariance of x, y and yaw of an increment.
Mat3 planar_covariance(const std::array<double, 21>& c) {
  Mat3 m;
  m << c[0], c[1], c[5], c[1], c[6], c[10], c[5], c[10], c[20];
  return m;
}

Vec3 planar(const Pose& pose) {
  return {pose.t.x(), pose.t.y(), 2.0 * std::atan2(pose.q.z(), pose.q.w())};
}

TEST(WheelOdometry, SolvesTheTwistOfADrive) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::int64_t> ticks(-5000, 5000);
  for (const drive::DriveKind kind : {drive::DriveKind::kDifferential, drive::DriveKind::kTracked,
                                      drive::DriveKind::kAckermann, drive::DriveKind::kOmnidirectional}) {
    drive::DriveSpec drive;
    drive.kind = kind;
    drive.wheel_base_m = kBase_m;
    drive.axle_distance_m = kAxles_m;
    const bool is_mecanum = kind == drive::DriveKind::kOmnidirectional;
    const WheelOdometrySpec spec =
        wheels_spec(is_mecanum ? mecanum_odometry_wheels(kBase_m, kAxles_m) : two_odometry_wheels(kBase_m));
    const WheelOdometry odometry(spec, 1);
    ASSERT_EQ(spec.wheels.size(), drive::wheel_count(kind));
    for (int trial = 0; trial < 100; ++trial) {
      std::vector<std::int64_t> before, after;
      drive::PerWheel ways{};
      for (std::size_t i = 0; i < spec.wheels.size(); ++i) {
        before.push_back(ticks(random));
        after.push_back(before.back() + ticks(random));
        ways.at(i) = spec.encoder.nominal_m_per_tick() * static_cast<double>(after[i] - before[i]);
      }
      const PlanarTwist expected = drive::twist_of(drive, ways);
      const Vec3 twist = odometry.step(before, after).twist;
      EXPECT_NEAR(twist.x(), expected.forward_m_s, 1e-14);
      EXPECT_NEAR(twist.y(), expected.lateral_m_s, 1e-14);
      EXPECT_NEAR(twist.z(), expected.angular_rad_s, 1e-13);
    }
  }
}

TEST(WheelOdometry, KnowsWheelsThatAreElsewhere) {
  // Three plain wheels that are steered along a turn about the origin of the body, which is not their axle.
  std::vector<OdometryWheel> wheels;
  for (const Vec2& place : {Vec2(0.3, 0.1), Vec2(-0.2, 0.4), Vec2(-0.1, -0.5)})
    wheels.push_back({.position_m = place, .rolling = Vec2(-place.y(), place.x()).normalized()});
  const WheelOdometrySpec spec = wheels_spec(wheels);
  const WheelOdometry odometry(spec, 1);
  std::vector<double> ways;
  for (const OdometryWheel& wheel : wheels) ways.push_back(0.5 * wheel.position_m.norm());
  const auto start = odometry.encoder().read(std::vector(3, 0.0)), end = odometry.encoder().read(ways);
  const Vec3 twist = odometry.step(start.ticks, end.ticks).twist;
  EXPECT_NEAR(twist.z(), 0.5, 2e-3);
  EXPECT_LT(twist.head<2>().norm(), 2e-4);
}

TEST(WheelOdometry, TracksTurnByTheirShare) {
  WheelOdometrySpec spec = wheels_spec(two_odometry_wheels(kBase_m));
  spec.turn_share = 0.75;
  const std::vector<std::int64_t> zero{0, 0}, turned{-100, 100};
  const double way = 200.0 * spec.encoder.nominal_m_per_tick();
  EXPECT_NEAR(WheelOdometry(spec, 1).step(zero, turned).twist.z(), 0.75 * way / kBase_m, 1e-14);
}

/// Drives increments that the model describes, each with other wheels, and compares errors with covariances.
/// @return the mean of the normalised squared errors, and its standard error
std::array<double, 2> mean_nees(const WheelOdometrySpec& spec, bool holds_sideways, double way_scale) {
  const int increments = test::sized(60'000, 1'000'000);
  std::mt19937_64 engine(17);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  double sum = 0.0, squares = 0.0;
  for (int trial = 0; trial < increments; ++trial) {
    const WheelOdometry odometry(spec, static_cast<std::uint64_t>(trial));
    Vec3 twist = way_scale * Vec3(0.05 + 0.02 * uniform(engine),
                                  holds_sideways ? 0.0 : 0.02 * uniform(engine), 0.15 * uniform(engine));
    std::vector<double> before, after;
    for (const OdometryWheel& wheel : spec.wheels) {
      const Vec2 contact(twist.x() - twist.z() * wheel.position_m.y(),
                         twist.y() + twist.z() * wheel.position_m.x());
      const double rolled = wheel.rolling.dot(contact);
      before.push_back(10.0 * uniform(engine));
      after.push_back(before.back() + rolled + spec.slip * std::sqrt(std::abs(rolled)) * normal(engine));
    }
    twist.y() += spec.side_slip * std::sqrt(twist.head<2>().norm()) * normal(engine);
    const PlanarStep step =
        odometry.step(odometry.encoder().read(before).ticks, odometry.encoder().read(after).ticks);
    const OdometryReading reading = odometry.reading(step, motion_of(step), 0.1);
    const Vec3 error = planar(motion_of({.twist = twist})) - planar(reading.T_odom_sensor);
    const double nees = error.dot(planar_covariance(reading.covariance).inverse() * error);
    sum += nees;
    squares += nees * nees;
  }
  const double mean = sum / increments;
  return {mean, std::sqrt((squares / increments - mean * mean) / increments)};
}

TEST(WheelOdometry, CovarianceIsThatOfTheErrors) {
  for (const bool is_mecanum : {false, true}) {
    for (const int errors : {0, 1, 2}) {
      WheelOdometrySpec spec =
          wheels_spec(is_mecanum ? mecanum_odometry_wheels(kBase_m, kAxles_m) : two_odometry_wheels(kBase_m));
      spec.side_slip = is_mecanum ? 0.0 : 1e-3;
      if (errors == 1) spec.slip = 2e-3;
      if (errors == 2) spec.radius_sigma = spec.encoder.radius_error_sigma = 0.02;
      const auto [mean, error] = mean_nees(spec, !is_mecanum, 1.0);
      EXPECT_NEAR(mean, 3.0, 3.0 * error) << is_mecanum << errors;
      RecordProperty("nees_" + std::to_string(is_mecanum) + std::to_string(errors),
                     std::to_string(mean) + " +- " + std::to_string(error));
    }
  }
}

TEST(WheelOdometry, CovarianceIsTooLargeForWheelsThatStand) {
  WheelOdometrySpec spec = wheels_spec(mecanum_odometry_wheels(kBase_m, kAxles_m));
  EXPECT_LT(mean_nees(spec, false, 1e-5)[0], 0.1);
  EXPECT_LT(mean_nees(spec, false, 1e-1)[0], 4.0);
}

TEST(WheelOdometry, CovarianceOfSumsIsNotTheSumOfCovariances) {
  const WheelOdometrySpec spec = wheels_spec(two_odometry_wheels(kBase_m));
  const WheelOdometry odometry(spec, 1);
  std::vector<std::int64_t> before = odometry.encoder().read(std::vector{0.0, 0.0}).ticks;
  double variance = 0.0, x = 0.0;
  for (int k = 1; k <= 10'000; ++k) {
    const std::vector<std::int64_t> after = odometry.encoder().read(std::vector{1e-3 * k, 1e-3 * k}).ticks;
    const PlanarStep step = odometry.step(before, after);
    x += step.twist.x();
    variance += step.covariance(0, 0);
    before = after;
  }
  EXPECT_LT(std::abs(x - 10.0), spec.encoder.nominal_m_per_tick()) << "roundings cancel";
  EXPECT_GT(std::sqrt(variance), 10.0 * spec.encoder.nominal_m_per_tick());
}

TEST(WheelOdometry, FollowsACircle) {
  WheelOdometrySpec spec = wheels_spec(two_odometry_wheels(kBase_m));
  spec.encoder.ticks_per_revolution = 1e7;
  const WheelOdometry odometry(spec, 1);
  constexpr double kSpeed = 0.4, kRate = 0.7, kInterval_s = 0.02;
  const auto ticks = [&](std::uint64_t k) {
    const double t = kInterval_s * static_cast<double>(k);
    return odometry.encoder()
        .read(std::vector{t * (kSpeed - 0.5 * kBase_m * kRate), t * (kSpeed + 0.5 * kBase_m * kRate)})
        .ticks;
  };
  const OdometryTrack<Pose> track({}, [&](Pose& pose, std::uint64_t k) {
    pose = pose * motion_of(odometry.step(ticks(k - 1), ticks(k)));
  });
  for (const std::uint64_t k : {1000u, 10u, 500u}) {
    const double a = kRate * kInterval_s * static_cast<double>(k);
    const Pose pose = track.at(k);
    EXPECT_LT((pose.t - kSpeed / kRate * Vec3(std::sin(a), 1.0 - std::cos(a), 0.0)).norm(), 1e-5) << k;
    EXPECT_LT(angle_between(pose.q, PlanarPose{0.0, 0.0, a}.level().q), 1e-5) << k;
    const OdometryReading reading =
        odometry.reading(odometry.step(ticks(k - 1), ticks(k)), pose, kInterval_s);
    EXPECT_NEAR(reading.linear_m_s.x(), kSpeed, 1e-4);
    EXPECT_NEAR(reading.angular_rad_s.z(), kRate, 1e-4);
  }
}

TEST(WheelOdometry, HasTheWheelsOfTheEncoderOfItsName) {
  WheelOdometrySpec spec = wheels_spec(two_odometry_wheels(kBase_m));
  spec.encoder.radius_error_sigma = 0.01;
  EXPECT_EQ(WheelOdometry(spec, 5).encoder().m_per_tick(), EncoderSensor(spec.encoder, 2, 5).m_per_tick());
}

TEST(WheelOdometry, TakesCountsAtTheEndsOfTheirRange) {
  const WheelOdometrySpec spec = wheels_spec(two_odometry_wheels(kBase_m));
  const WheelOdometry odometry(spec, 1);
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max(),
                         kLeast = std::numeric_limits<std::int64_t>::min();
  const double tick_m = spec.encoder.nominal_m_per_tick();
  EXPECT_DOUBLE_EQ(odometry.step(std::vector{kMost - 1, kMost - 1}, std::vector{kMost, kMost}).twist.x(),
                   tick_m);
  const PlanarStep step = odometry.step(std::vector{kLeast, kLeast}, std::vector{kMost, kMost});
  EXPECT_DOUBLE_EQ(step.twist.x(), 0x1p64 * tick_m);
  EXPECT_TRUE(step.covariance.allFinite());
}

TEST(WheelOdometry, RefusesBadInput) {
  const auto refusal = [](const std::function<void(WheelOdometrySpec&)>& change) -> std::string {
    WheelOdometrySpec spec = wheels_spec(two_odometry_wheels(kBase_m));
    spec.name = "chassis";
    spec.encoder.name = "chassis.wheels";
    change(spec);
    try {
      const WheelOdometry odometry(spec, 1);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kBadInput);
      return error.what();
    }
    return "";
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find("chassis") != std::string::npos && text.find(part) != std::string::npos;
  };
  EXPECT_PRED2(has, refusal([](WheelOdometrySpec& s) { s.wheels.clear(); }), "do not determine");
  EXPECT_PRED2(has, refusal([](WheelOdometrySpec& s) {
                 s.wheels.pop_back();
                 s.wheels[0].holds_sideways = false;
               }),
               "do not determine");
  EXPECT_PRED2(has, refusal([](WheelOdometrySpec& s) { s.wheels[0] = s.wheels[1]; }), "do not determine");
  EXPECT_PRED2(has, refusal([](WheelOdometrySpec& s) { s.wheels[0].position_m.x() = std::nan(""); }),
               "wheels");
  EXPECT_PRED2(has, refusal([](WheelOdometrySpec& s) { s.wheels[0].rolling.setZero(); }), "wheels");
  EXPECT_PRED2(has, refusal([](WheelOdometrySpec& s) { s.turn_share = 0.0; }), "turn_share");
  EXPECT_PRED2(has, refusal([](WheelOdometrySpec& s) { s.radius_sigma = 0.6; }), "radius_sigma");
  EXPECT_PRED2(has, refusal([](WheelOdometrySpec& s) { s.slip = -1.0; }), "slip");
  EXPECT_PRED2(has, refusal([](WheelOdometrySpec& s) { s.side_slip = INFINITY; }), "side_slip");
  EXPECT_PRED2(has, refusal([](WheelOdometrySpec& s) { s.off_plane.tilt_rad = std::nan(""); }),
               "off_plane.tilt_rad");
  EXPECT_PRED2(has, refusal([](WheelOdometrySpec& s) { s.encoder.wheel_radius_m = 0.0; }), "wheel_radius_m");
  const WheelOdometry odometry(wheels_spec(two_odometry_wheels(kBase_m)), 1);
  const std::vector<std::int64_t> one{0}, two{0, 0};
  EXPECT_THROW(odometry.step(one, two), Error);
  EXPECT_THROW(odometry.step(two, one), Error);
}

}  // namespace
}  // namespace hallway::sense
