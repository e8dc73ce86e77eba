// SPDX-License-Identifier: MIT
#include "sense/odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <thread>

#include "sense/odometry_track.hpp"
#include "test_motions.hpp"

namespace hallway::sense {
namespace {

double at(const std::array<double, 21>& upper, std::size_t row, std::size_t column) {
  std::size_t index = 0;
  for (std::size_t i = 0; i < row; ++i) index += 6 - i;
  return upper.at(index + column - row);
}

TEST(Odometry, IncrementIsTheMotionOfAConstantTwist) {
  for (const double turn : {-7.0, -0.3, -0.02, -0.0199, 0.0, 1e-9, 1e-3, 0.0199, 0.02, 0.5, 3.1, 40.0}) {
    const PlanarStep step{.twist = Vec3(0.8, -0.3, turn)};
    const PlanarPose expected =
        displacement({.from = {0.8, -0.3, turn}, .to = {0.8, -0.3, turn}, .duration_ns = 1'000'000'000});
    const Pose motion = motion_of(step);
    EXPECT_NEAR(motion.t.x(), expected.x_m, 1e-13) << turn;
    EXPECT_NEAR(motion.t.y(), expected.y_m, 1e-13) << turn;
    EXPECT_LT(angle_between(motion.q, expected.level().q), 1e-13) << turn;
  }
}

/// Errors of the twist become errors of the increment by the derivative, here by differences.
TEST(Odometry, CovarianceFollowsTheDerivative) {
  const auto increment = [](const Vec3& twist) {
    const Pose motion = motion_of({.twist = twist});
    return Vec3(motion.t.x(), motion.t.y(), twist.z());
  };
  Mat3 covariance;
  covariance << 4.0, 0.5, 0.2, 0.5, 3.0, -0.4, 0.2, -0.4, 1.0;
  for (const double turn : {-2.0, -0.0199, 0.0, 0.0201, 0.7}) {
    const Vec3 twist(0.8, -0.3, turn);
    Mat3 derivative;
    for (int i = 0; i < 3; ++i)
      derivative.col(i) =
          (increment(twist + 1e-5 * Vec3::Unit(i)) - increment(twist - 1e-5 * Vec3::Unit(i))) / 2e-5;
    const Mat3 expected = derivative * covariance * derivative.transpose();
    const auto upper =
        covariance_of({.twist = twist, .covariance = covariance}, {.height_m = 0.1, .tilt_rad = 0.2});
    const std::size_t places[]{0, 1, 5};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i; j < 3; ++j)
        EXPECT_NEAR(at(upper, places[i], places[j]), expected(static_cast<int>(i), static_cast<int>(j)), 1e-8)
            << turn;
    }
    EXPECT_DOUBLE_EQ(at(upper, 2, 2), 0.01 * std::hypot(0.8, 0.3));
    EXPECT_DOUBLE_EQ(at(upper, 3, 3), 0.04 * std::hypot(0.8, 0.3));
    EXPECT_EQ(at(upper, 0, 2), 0.0);
  }
}

TEST(Odometry, SaysWhatIsNotMeasured) {
  const PlanarStep step{.twist = Vec3(0.2, 0.1, 0.0), .covariance = Mat3::Identity(), .turn_is_known = false};
  const OdometryReading reading = odometry_reading(step, {}, {}, 0.1);
  EXPECT_NEAR(reading.linear_m_s.x(), 2.0, 1e-12);
  EXPECT_EQ(reading.linear_m_s.z(), 0.0);
  for (const double rate : reading.angular_rad_s) EXPECT_TRUE(std::isnan(rate));
  EXPECT_EQ(at(reading.covariance, 0, 0), 1.0);
  EXPECT_EQ(at(reading.covariance, 5, 5), INFINITY);
  EXPECT_EQ(at(reading.covariance, 0, 5), 0.0);
  const OdometryReading nothing =
      odometry_reading({.turn_is_known = false, .way_is_known = false}, {}, {}, 0.1);
  EXPECT_TRUE(std::isnan(nothing.linear_m_s.x()));
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(at(nothing.covariance, i, i), INFINITY) << i;
  EXPECT_TRUE(std::isnan(odometry_reading({}, {}, {}, 0.0).linear_m_s.x()))
      << "an empty interval has no twist";
}

TEST(Odometry, TruthIsOfTheSensor) {
  const motions::Waves waves;
  const Pose mount{from_yaw_pitch_roll(0.3, 0.1, 0.2), Vec3(0.5, 0.2, 0.1)};
  const OdometryTruth truth = odometry_truth(waves, mount, 0, 1'000'000'000, 1'100'000'000);
  const Pose start = waves.pose_at(0) * mount, before = waves.pose_at(1'000'000'000) * mount,
             now = waves.pose_at(1'100'000'000) * mount;
  EXPECT_LT(((start * truth.T_start_sensor).t - now.t).norm(), 1e-14);
  EXPECT_LT(((before * truth.T_before_sensor).t - now.t).norm(), 1e-14);
  EXPECT_LT(angle_between((before * truth.T_before_sensor).q, now.q), 1e-14);
}

/// Sums that depend on their order in the last bits.
double sum_up_to(std::uint64_t n) {
  double sum = 0.0;
  for (std::uint64_t k = 1; k <= n; ++k) sum += 1.0 / static_cast<double>(k);
  return sum;
}

TEST(OdometryTrack, IsTheSameInAnyOrder) {
  std::uint64_t steps = 0;
  const OdometryTrack<double> track(0.0, [&](double& sum, std::uint64_t k) {
    sum += 1.0 / static_cast<double>(k);
    ++steps;
  });
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 2000; ++trial) {
    const std::uint64_t k = random() % 5000;
    ASSERT_EQ(track.at(k), sum_up_to(k)) << k;
  }
  EXPECT_LT(steps, 2000u * 256u + 5000u);
}

TEST(OdometryTrack, TakesOneStepForTheNext) {
  std::vector<std::uint64_t> asked;
  const OdometryTrack<double> track(0.0, [&](double&, std::uint64_t k) { asked.push_back(k); });
  for (std::uint64_t k = 0; k < 1000; ++k) {
    track.at(k);
    track.at(k);
  }
  ASSERT_EQ(asked.size(), 999u);
  for (std::size_t i = 0; i < asked.size(); ++i) EXPECT_EQ(asked[i], i + 1);
  asked.clear();
  track.at(900);
  EXPECT_EQ(asked.front(), 769u);
}

TEST(OdometryTrack, AStepThatFailsChangesNothing) {
  bool fails = true;
  const OdometryTrack<double> track(0.0, [&](double& sum, std::uint64_t k) {
    sum += static_cast<double>(k);
    if (fails && k == 300) throw std::runtime_error("no");
  });
  EXPECT_EQ(track.at(10), 55.0);
  EXPECT_THROW(track.at(400), std::runtime_error);
  EXPECT_EQ(track.at(11), 66.0);
  fails = false;
  EXPECT_EQ(track.at(400), 400.0 * 401.0 / 2.0);
}

TEST(OdometryTrack, ThreadsGetTheSame) {
  const OdometryTrack<double> track(
      0.0, [](double& sum, std::uint64_t k) { sum += 1.0 / static_cast<double>(k); });
  std::vector<std::thread> threads;
  std::array<int, 4> wrong{};
  for (std::size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (std::uint64_t i = 0; i < 300; ++i) {
        const std::uint64_t k = (i * 37 + t * 911) % 3000;
        if (track.at(k) != sum_up_to(k)) ++wrong.at(t);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, (std::array<int, 4>{}));
}

}  // namespace
}  // namespace hallway::sense
