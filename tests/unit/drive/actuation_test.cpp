// SPDX-License-Identifier: MIT
#include "drive/actuation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "unit/drive/drives.hpp"

namespace hallway::drive {
namespace {

/// Mean and mean square of what differs from a declared mean.
class Moments {
 public:
  void add(double value, const Disturbance& declared) {
    const double deviation = value - declared.mean;
    sum_ += deviation;
    squares_ += deviation * deviation;
    ++count_;
  }

  /// Within three standard errors of an autoregressive sequence.
  void expect(const Disturbance& declared, const char* what) const {
    const double n = static_cast<double>(count_);
    const double keep =
        declared.correlation_ns == 0 ? 0.0 : std::exp(-1e7 / static_cast<double>(declared.correlation_ns));
    const double variance = declared.sigma * declared.sigma;
    EXPECT_NEAR(sum_ / n, 0.0, 3.0 * declared.sigma * std::sqrt((1.0 + keep) / (1.0 - keep) / n)) << what;
    EXPECT_NEAR(squares_ / n, variance,
                3.0 * variance * std::sqrt(2.0 * (1.0 + keep * keep) / (1.0 - keep * keep) / n))
        << what;
  }

 private:
  double sum_ = 0.0, squares_ = 0.0;
  std::size_t count_ = 0;
};

TEST(Actuation, SlipAndNoiseAreAsDeclared) {
  DriveSpec spec{.wheel_base_m = 0.4};
  testing::add_noise(spec);
  Actuation actuation(spec, 21);
  const PlanarTwist driven{0.5, 0.0, 0.8};
  std::array<Moments, 5> moments;
  for (std::int64_t knot = 0; knot < 1'000'000; ++knot) {
    const Effect effect = actuation.at(knot * kKnotNs, driven);
    const double left = effect.body.forward_m_s - 0.2 * effect.body.angular_rad_s;
    const double right = effect.body.forward_m_s + 0.2 * effect.body.angular_rad_s;
    moments[0].add(0.5 * (effect.wheels[0] + effect.wheels[1]) / 0.5 - 1.0, spec.forward_noise);
    moments[1].add((effect.wheels[1] - effect.wheels[0]) / 0.4 / 0.8 - 1.0, spec.angular_noise);
    moments[2].add(effect.body.lateral_m_s / effect.body.forward_m_s, spec.lateral_drift);
    moments[3].add(1.0 - left / effect.wheels[0], spec.left_slip);
    moments[4].add(1.0 - right / effect.wheels[1], spec.right_slip);
  }
  moments[0].expect(spec.forward_noise, "forward noise");
  moments[1].expect(spec.angular_noise, "angular noise");
  moments[2].expect(spec.lateral_drift, "lateral drift");
  moments[3].expect(spec.left_slip, "left slip");
  moments[4].expect(spec.right_slip, "right slip");
}

TEST(Actuation, WithoutFaultsTheBodyFollows) {
  testing::Dice dice(3);
  for (int i = 0; i < 100; ++i) {
    DriveSpec spec = testing::random_spec(dice);
    spec.turn_slip = 0.0;
    PlanarTwist driven = testing::random_command(dice);
    if (spec.kind != DriveKind::kOmnidirectional) driven.lateral_m_s = 0.0;
    Actuation actuation(spec, 1);
    EXPECT_TRUE(actuation.is_constant());
    const PlanarTwist body = actuation.at(0, driven).body;
    EXPECT_NEAR(body.forward_m_s, driven.forward_m_s, 1e-14);
    EXPECT_NEAR(body.lateral_m_s, driven.lateral_m_s, 1e-14);
    EXPECT_NEAR(body.angular_rad_s, driven.angular_rad_s, 1e-13);
  }
}

TEST(Actuation, TracksLoseTheirShareOfATurn) {
  const DriveSpec spec{.kind = DriveKind::kTracked, .wheel_base_m = 0.4, .turn_slip = 0.25};
  const Effect effect = Actuation(spec, 1).at(0, {0.3, 0.0, 1.0});
  EXPECT_NEAR(effect.body.angular_rad_s, 0.75, 1e-15);
  EXPECT_NEAR(effect.body.forward_m_s, 0.3, 1e-15);
  EXPECT_NEAR(effect.wheels[1] - effect.wheels[0], 0.4, 1e-15);
}

TEST(Actuation, SlipOfOneSideTurnsTheBody) {
  const DriveSpec spec{.wheel_base_m = 0.5, .left_slip = {.mean = 0.2}};
  const Effect effect = Actuation(spec, 1).at(0, {1.0, 0.0, 0.0});
  EXPECT_EQ(effect.wheels[0], 1.0);
  EXPECT_NEAR(effect.body.forward_m_s, 0.9, 1e-15);
  EXPECT_NEAR(effect.body.angular_rad_s, 0.4, 1e-15);
}

TEST(Actuation, SlippingCarStaysOnItsCircle) {
  const DriveSpec spec{
      .kind = DriveKind::kAckermann, .left_slip = {.mean = 0.2}, .right_slip = {.mean = 0.1}};
  const Effect effect = Actuation(spec, 1).at(0, {1.0, 0.0, 0.6});
  EXPECT_NEAR(effect.body.forward_m_s, 0.85, 1e-15);
  EXPECT_NEAR(effect.body.angular_rad_s / effect.body.forward_m_s, 0.6, 1e-15);
}

TEST(Actuation, NoiseOfACarsSpeedKeepsItOnItsCircle) {
  const DriveSpec spec{.kind = DriveKind::kAckermann, .forward_noise = {0.1, 0.2, 0}};
  Actuation actuation(spec, 1);
  for (std::int64_t t = 0; t < 1'000'000'000; t += 3'456'789) {
    const Effect effect = actuation.at(t, {1.0, 0.0, 0.6});
    EXPECT_NEAR(effect.body.angular_rad_s, 0.6 * effect.body.forward_m_s, 1e-15);
  }
}

TEST(Actuation, DriftIsAShareOfTheForwardSpeed) {
  const DriveSpec spec{.lateral_drift = {.mean = 0.1}};
  const Effect effect = Actuation(spec, 1).at(0, {-0.5, 0.0, 0.0});
  EXPECT_NEAR(effect.body.lateral_m_s, -0.05, 1e-16);
  EXPECT_EQ(effect.wheels[0], -0.5);
}

TEST(Actuation, DisturbancesDoNotChangeEachOther) {
  DriveSpec spec{.forward_noise = {0.0, 0.1, 100'000'000}};
  Actuation alone(spec, 5);
  testing::add_noise(spec);
  spec.forward_noise = {0.0, 0.1, 100'000'000};
  Actuation among(spec, 5);
  for (std::int64_t t = 0; t < 3'000'000'000; t += 3'456'789) {
    const double speed = among.at(t, {1.0, 0.0, 0.0}).wheels[0];
    EXPECT_EQ(speed, alone.at(t, {1.0, 0.0, 0.0}).wheels[0]);
  }
}

TEST(Actuation, RobotAtRestStaysAtRest) {
  DriveSpec spec{.kind = DriveKind::kOmnidirectional};
  testing::add_noise(spec);
  Actuation actuation(spec, 5);
  for (std::int64_t t = 0; t < 1'000'000'000; t += 3'456'789)
    EXPECT_EQ(actuation.at(t, {}).body, PlanarTwist{});
}

}  // namespace
}  // namespace hallway::drive
