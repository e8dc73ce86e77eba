// SPDX-License-Identifier: MIT
#include "geometry/planar_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.hpp"
#include "support/planar_quadrature.hpp"

namespace hallway {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

/// Random numbers in order.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed, stream_id("planar_motion_test")) {}
  double within(double low, double high) { return random_.uniform(0, next_++, low, high); }
  std::int64_t whole(std::int64_t low, std::int64_t high) {
    return std::min(high, low + static_cast<std::int64_t>(within(0.0, static_cast<double>(high - low + 1))));
  }

 private:
  Random random_;
  std::uint64_t next_ = 0;
};

TwistRamp random_ramp(Dice& dice) {
  const auto twist = [&] {
    return PlanarTwist{dice.within(-2.0, 2.0), dice.within(-2.0, 2.0), dice.within(-4.0, 4.0)};
  };
  return {twist(), twist(), dice.whole(1, 3 * kSecond)};
}

oracle::Place integrated(const TwistRamp& ramp) {
  const long double whole = static_cast<long double>(ramp.duration_ns) * 1e-9L;
  const auto rates = [&](long double t) -> oracle::Rates {
    const auto at = [&](double from, double to) {
      return from + (static_cast<long double>(to) - from) * (t / whole);
    };
    return {at(ramp.from.forward_m_s, ramp.to.forward_m_s), at(ramp.from.lateral_m_s, ramp.to.lateral_m_s),
            at(ramp.from.angular_rad_s, ramp.to.angular_rad_s)};
  };
  return oracle::integrate(rates, 8000, whole / 8000);
}

TEST(PlanarMotion, StraightRampIsExact) {
  const PlanarPose moved = displacement({{0.25, 0.0, 0.0}, {0.75, 0.0, 0.0}, 4 * kSecond});
  EXPECT_DOUBLE_EQ(moved.x_m, 2.0);
  EXPECT_EQ(moved.y_m, 0.0);
  EXPECT_EQ(moved.yaw_rad, 0.0);
}

TEST(PlanarMotion, SidewaysIsToTheLeft) {
  const PlanarPose moved = displacement({{0.0, 0.5, 0.0}, {0.0, 0.5, 0.0}, 2 * kSecond});
  EXPECT_EQ(moved.x_m, 0.0);
  EXPECT_DOUBLE_EQ(moved.y_m, 1.0);
}

TEST(PlanarMotion, CircleHasItsClosedForm) {
  for (const double rate : {1e-9, 1e-4, 0.3, -1.7, 4.0}) {
    for (const double time : {0.001, 1.0, 10.0}) {
      const PlanarTwist twist{0.8, 0.0, rate};
      const PlanarPose moved = displacement({twist, twist, std::llround(time * 1e9)});
      const double angle = rate * time;
      const double x =
          0.8 * time * (std::abs(angle) < 1e-3 ? 1.0 - angle * angle / 6.0 : std::sin(angle) / angle);
      const double y = 0.8 / rate * 2.0 * std::pow(std::sin(0.5 * angle), 2);
      EXPECT_NEAR(moved.x_m, x, 1e-13) << rate << " " << time;
      EXPECT_NEAR(moved.y_m, y, 1e-13) << rate << " " << time;
      EXPECT_NEAR(moved.yaw_rad, angle, 1e-14);
    }
  }
}

TEST(PlanarMotion, AgreesWithAnIndependentQuadrature) {
  Dice dice(1);
  for (int i = 0; i < 40; ++i) {
    const TwistRamp ramp = random_ramp(dice);
    const PlanarPose moved = displacement(ramp);
    const oracle::Place place = integrated(ramp);
    EXPECT_NEAR(moved.x_m, static_cast<double>(place.x), 2e-13);
    EXPECT_NEAR(moved.y_m, static_cast<double>(place.y), 2e-13);
    EXPECT_NEAR(moved.yaw_rad, static_cast<double>(place.yaw), 2e-14);
  }
}

TEST(PlanarMotion, PartsOfARampMakeTheWhole) {
  Dice dice(2);
  for (int i = 0; i < 200; ++i) {
    const TwistRamp ramp = random_ramp(dice);
    std::vector<std::int64_t> cuts{0, ramp.duration_ns};
    for (int k = 0; k < 20; ++k) cuts.push_back(dice.whole(0, ramp.duration_ns));
    std::ranges::sort(cuts);
    PlanarPose pose;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) pose = move(pose, cut(ramp, cuts[k], cuts[k + 1]));
    const PlanarPose whole = displacement(ramp);
    EXPECT_NEAR(pose.x_m, whole.x_m, 1e-12);
    EXPECT_NEAR(pose.y_m, whole.y_m, 1e-12);
    EXPECT_NEAR(pose.yaw_rad, whole.yaw_rad, 1e-13);
  }
}

TEST(PlanarMotion, TwistIsLinearAndExactAtTheEnds) {
  const TwistRamp ramp{{0.1, 0.7, -0.3}, {0.3, 0.1, 0.9}, 3};
  EXPECT_EQ(twist_at(ramp, 0), ramp.from);
  EXPECT_EQ(twist_at(ramp, 3), ramp.to);
  EXPECT_NEAR(twist_at(ramp, 1).angular_rad_s, 0.1, 1e-15);
  EXPECT_EQ(cut(ramp, 0, 3), ramp);
  EXPECT_EQ(cut(ramp, 3, 3).from, ramp.to);
  EXPECT_EQ(displacement({{1.0, 1.0, 1.0}, {2.0, 2.0, 2.0}, 0}).x_m, 0.0);
}

TEST(PlanarMotion, PoseMovesInItsOwnPlane) {
  Dice dice(3);
  const Pose start{from_yaw_pitch_roll(0.7, 0.3, -0.2), {1.0, 2.0, 3.0}};
  Pose pose = start;
  PlanarPose planar;
  for (int i = 0; i < 20; ++i) {
    const TwistRamp ramp = random_ramp(dice);
    pose = move(pose, ramp);
    planar = move(planar, ramp);
  }
  const Vec3 local = start.inverse() * pose.t;
  EXPECT_NEAR(local.x(), planar.x_m, 1e-12);
  EXPECT_NEAR(local.y(), planar.y_m, 1e-12);
  EXPECT_NEAR(local.z(), 0.0, 1e-12);
  EXPECT_NEAR((pose.q * Vec3::UnitZ() - start.q * Vec3::UnitZ()).norm(), 0.0, 1e-13);
  EXPECT_NEAR((pose.q * Vec3::UnitX()).dot(start.q * Vec3::UnitX()), std::cos(planar.yaw_rad), 1e-12);
}

}  // namespace
}  // namespace hallway
