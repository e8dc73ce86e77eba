// SPDX-License-Identifier: MIT
#include "sense/imu_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "base/error.hpp"
#include "test_motions.hpp"

namespace hallway::sense {
namespace {

constexpr std::int64_t kInterval_ns = 5'000'000;
constexpr double kInterval_s = 5e-3;
constexpr int kReadings = 1'000'000;

ImuSensorSpec perfect_imu() {
  return {.name = "imu"};
}

/// Only the z axis of a gyro.
ImuSensorSpec yaw_gyro() {
  ImuSensorSpec spec = perfect_imu();
  spec.gyro.axes = {false, false, true};
  spec.accelerometer.axes = {false, false, false};
  return spec;
}

ImuTruth some_truth(const Vec3& angular = Vec3(0.1, -0.2, 0.3), const Vec3& force = Vec3(1.0, -2.0, 9.8)) {
  return {.means = {.angular_rad_s = angular, .force_m_s2 = force}};
}

TEST(ImuSensor, WithoutErrorsGivesTheMeans) {
  const ImuSensor imu(perfect_imu(), kInterval_s, 1);
  const motions::Waves waves;
  const ImuTruth truth = imu.truth(waves, 4, 20'000'000, 25'000'000);
  const ImuReading reading = imu.read(truth, 4, kInterval_ns);
  EXPECT_EQ(reading.angular_rad_s, truth.means.angular_rad_s);
  EXPECT_EQ(reading.force_m_s2, truth.means.force_m_s2);
  EXPECT_EQ(truth.angular_bias, Vec3(Vec3::Zero()));
  EXPECT_EQ(reading.angular_covariance, (std::array<double, 6>{}));
}

TEST(ImuSensor, AGyroHasOnlyItsAxes) {
  ImuSensorSpec spec = yaw_gyro();
  spec.gyro.noise = 1e-3;
  const ImuSensor gyro(spec, kInterval_s, 1);
  const ImuTruth truth = gyro.truth(motions::Circle(1.0, 0.5), 1, 0, kInterval_ns);
  const ImuReading reading = gyro.read(truth, 1, kInterval_ns);
  EXPECT_TRUE(std::isnan(reading.angular_rad_s.x()) && std::isnan(reading.angular_rad_s.y()));
  EXPECT_NEAR(reading.angular_rad_s.z(), 0.5, 0.1);
  for (const double force : reading.force_m_s2) EXPECT_TRUE(std::isnan(force));
  for (const double variance : reading.force_covariance) EXPECT_TRUE(std::isnan(variance));
  for (std::size_t i = 0; i < 5; ++i) EXPECT_TRUE(std::isnan(reading.angular_covariance.at(i)));
  EXPECT_DOUBLE_EQ(reading.angular_covariance[5], 1e-6 / kInterval_s);
  EXPECT_TRUE(std::isnan(truth.angular_bias.x()));
  EXPECT_EQ(truth.angular_bias.z(), 0.0);
  EXPECT_NEAR(truth.means.force_m_s2.y(), 0.5, 1e-12);
}

/// Allan variance of rates for clusters of n readings that do not overlap.
/// @return with it the number of differences
std::pair<double, double> allan_variance(const std::vector<double>& rates, std::size_t n) {
  std::vector<double> means;
  for (std::size_t begin = 0; begin + n <= rates.size(); begin += n) {
    double sum = 0.0;
    for (std::size_t i = begin; i < begin + n; ++i) sum += rates[i];
    means.push_back(sum / static_cast<double>(n));
  }
  double squares = 0.0;
  for (std::size_t i = 1; i < means.size(); ++i)
    squares += (means[i] - means[i - 1]) * (means[i] - means[i - 1]);
  const auto differences = static_cast<double>(means.size() - 1);
  return {0.5 * squares / differences, differences};
}

/// Compares levels and the slope of the deviation over three decades.
/// @param correlated  squares of the correlations of differences of neighbouring clusters, of both sides, with 1 for itself
void expect_allan(const std::vector<double>& rates, const std::function<double(double n)>& variance,
                  double correlated, double slope) {
  std::vector<double> logarithms;
  double slope_error = 0.0;
  for (const std::size_t n : {1u, 10u, 100u, 1000u}) {
    const auto [measured, differences] = allan_variance(rates, n);
    const double expected = variance(static_cast<double>(n)),
                 error = std::sqrt(2.0 * correlated / differences);
    EXPECT_NEAR(measured / expected, 1.0, 3.0 * error) << n;
    logarithms.push_back(0.5 * std::log10(measured / expected * variance(static_cast<double>(n))));
    slope_error = 0.5 * error / std::log(10.0);  // of the last one, the greatest by far
  }
  EXPECT_NEAR((logarithms[3] - logarithms[1]) / 2.0, slope, 3.0 * slope_error / 2.0 + 1e-3);
}

TEST(ImuSensor, WhiteNoiseHasItsAllanDeviation) {
  ImuSensorSpec spec = yaw_gyro();
  spec.gyro.noise = 2e-3;
  spec.accelerometer.axes = {true, false, false};
  spec.accelerometer.noise = 5e-2;
  const ImuSensor imu(spec, kInterval_s, 3);
  std::vector<double> rates, forces;
  double product = 0.0;
  for (std::uint64_t k = 0; k < kReadings; ++k) {
    const ImuReading reading = imu.read(some_truth(), k, kInterval_ns);
    rates.push_back(reading.angular_rad_s.z() - 0.3);
    forces.push_back(reading.force_m_s2.x() - 1.0);
    product += rates.back() * forces.back();
  }
  const auto white = [](double density) {
    return [density](double n) { return density * density / (n * kInterval_s); };
  };
  // Differences of neighbours share a mean: correlation -1/2 on both sides.
  expect_allan(rates, white(2e-3), 1.5, -0.5);
  expect_allan(forces, white(5e-2), 1.5, -0.5);
  const double sigmas = 2e-3 * 5e-2 / kInterval_s;
  EXPECT_NEAR(product / kReadings / sigmas, 0.0, 3.0 / std::sqrt(kReadings));
}

TEST(ImuSensor, AxesAreIndependent) {
  ImuSensorSpec spec = perfect_imu();
  spec.gyro.noise = spec.accelerometer.noise = spec.gyro.walk = spec.accelerometer.walk =
      std::sqrt(kInterval_s);
  const ImuSensor imu(spec, kInterval_s, 2);
  const motions::Standing still(Quat::Identity());
  using Six = Eigen::Matrix<double, 6, 1>;
  constexpr std::uint64_t kPairs = 20'000;
  Eigen::Matrix<double, 12, 12> products = Eigen::Matrix<double, 12, 12>::Zero();
  Six last_bias = Six::Zero();
  for (std::uint64_t k = 1; k <= kPairs; ++k) {
    const ImuTruth truth = imu.truth(still, k, 0, kInterval_ns);
    const ImuReading reading = imu.read(truth, k, kInterval_ns);
    Six bias, white;
    bias << truth.angular_bias, truth.force_bias;
    white << reading.angular_rad_s - truth.means.angular_rad_s, reading.force_m_s2 - truth.means.force_m_s2;
    Eigen::Matrix<double, 12, 1> all;  // of variance 1, and of variance interval^2 for the steps of the walks
    all << white - bias, (bias - last_bias) / kInterval_s;
    last_bias = bias;
    products += all * all.transpose();
  }
  products /= static_cast<double>(kPairs);
  // 78 comparisons: 4 standard errors.
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j <= i; ++j)
      EXPECT_NEAR(products(i, j), i == j ? 1.0 : 0.0, 4.0 * std::sqrt((i == j ? 2.0 : 1.0) / kPairs))
          << i << j;
  }
}

TEST(ImuSensor, BiasWalkHasItsAllanDeviation) {
  ImuSensorSpec spec = yaw_gyro();
  constexpr double kWalk = 1e-3;
  spec.gyro.walk = kWalk;
  spec.gyro.bias = Vec3(0.0, 0.0, 0.02);
  const ImuSensor gyro(spec, kInterval_s, 4);
  const motions::Standing still(Quat::Identity());
  std::vector<double> rates;
  for (std::int64_t k = 0; k < kReadings; ++k) {
    const ImuTruth truth =
        gyro.truth(still, static_cast<std::uint64_t>(k), k * kInterval_ns, (k + 1) * kInterval_ns);
    rates.push_back(gyro.read(truth, static_cast<std::uint64_t>(k), kInterval_ns).angular_rad_s.z());
    ASSERT_EQ(rates.back(), truth.angular_bias.z());
  }
  EXPECT_EQ(rates[0], 0.02);
  // K^2 tau / 3, and what a walk in steps adds to it; differences of neighbours have a correlation of at most 1/4 + 1/(4 n^2).
  expect_allan(
      rates, [](double n) { return kWalk * kWalk * kInterval_s * (2.0 * n * n + 1.0) / (6.0 * n); },
      1.0 + 2.0 / 16.0, 0.5);
}

TEST(ImuSensor, FixedErrorsHaveTheirStatistics) {
  ImuSensorSpec spec = perfect_imu();
  spec.gyro.bias = Vec3(0.01, 0.02, 0.03);
  spec.gyro.bias_sigma = 0.005;
  spec.gyro.scale_sigma = 0.01;
  spec.gyro.misalignment_rad = 0.002;
  constexpr int kSeeds = 20'000;
  Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const ImuSensor imu(spec, kInterval_s, seed);
    const ImuTruth still = imu.truth(motions::Standing(Quat::Identity()), 0, 0, kInterval_ns);
    ImuTruth turning = still;
    turning.means.angular_rad_s = Vec3(1.0, 0.0, 0.0);
    const Vec3 bias = still.angular_bias - spec.gyro.bias;
    const Vec3 column = imu.read(turning, 0, kInterval_ns).angular_rad_s - still.angular_bias;
    EXPECT_LE(bias.lpNorm<Eigen::Infinity>(), 4.0 * 0.005 + 1e-15);
    const Vec3 normed(bias.z() / 0.005, (column.x() - 1.0) / 0.01, column.y() / 0.002);
    sum += normed;
    squares += normed.cwiseAbs2();
    EXPECT_EQ(imu.read(still, 0, kInterval_ns).force_m_s2, still.means.force_m_s2)
        << "no error of forces is declared";
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(sum[i] / kSeeds, 0.0, 3.0 / std::sqrt(kSeeds)) << i;
    EXPECT_NEAR(squares[i] / kSeeds, 1.0, 3.0 * std::sqrt(2.0 / kSeeds)) << i;
  }
}

TEST(ImuSensor, SaturatesAndQuantises) {
  ImuSensorSpec spec = perfect_imu();
  spec.gyro.limit = 0.25;
  spec.gyro.resolution = 0.1;
  spec.accelerometer.resolution = 1e-3;
  const ImuSensor imu(spec, kInterval_s, 1);
  const ImuReading reading =
      imu.read(some_truth(Vec3(0.149, -7.0, 1e300), Vec3(0.00049, 1e300, -0.0005)), 0, kInterval_ns);
  EXPECT_DOUBLE_EQ(reading.angular_rad_s.x(), 0.1);
  EXPECT_NEAR(reading.angular_rad_s.y(), -0.25, 0.05 + 1e-12);
  EXPECT_NEAR(reading.angular_rad_s.z(), 0.25, 0.05 + 1e-12);
  EXPECT_EQ(reading.force_m_s2.x(), 0.0);
  EXPECT_EQ(reading.force_m_s2.y(), 1e300);
  EXPECT_DOUBLE_EQ(reading.force_m_s2.z(), -1e-3);
}

TEST(ImuSensor, ReadingsDependOnSeedNameAndNumberAlone) {
  ImuSensorSpec spec = perfect_imu();
  spec.gyro.noise = spec.gyro.walk = spec.accelerometer.noise = 1e-3;
  const auto read = [](const ImuSensorSpec& s, std::uint64_t seed, std::uint64_t k) {
    const ImuSensor imu(s, kInterval_s, seed);
    return imu.read(imu.truth(motions::Standing(Quat::Identity()), k, 0, kInterval_ns), k, kInterval_ns);
  };
  const ImuReading one = read(spec, 1, 77);
  EXPECT_EQ(read(spec, 1, 77).angular_rad_s, one.angular_rad_s);
  EXPECT_NE(read(spec, 2, 77).angular_rad_s, one.angular_rad_s);
  EXPECT_NE(read(spec, 1, 78).angular_rad_s, one.angular_rad_s);
  EXPECT_NE(one.angular_rad_s.x(), one.angular_rad_s.y());
  ImuSensorSpec fewer = spec;
  fewer.gyro.axes = {true, false, false};
  fewer.accelerometer.noise = 0.0;
  EXPECT_EQ(read(fewer, 1, 77).angular_rad_s.x(), one.angular_rad_s.x());
  spec.name = "other";
  EXPECT_NE(read(spec, 1, 77).angular_rad_s, one.angular_rad_s);
}

TEST(ImuSensor, WorksAtAnyRate) {
  ImuSensorSpec spec = perfect_imu();
  spec.gyro.noise = 1e-3;
  for (const std::int64_t interval_ns : {1L, 1000L, 1'000'000'000'000L}) {
    const double interval_s = 1e-9 * static_cast<double>(interval_ns);
    const ImuSensor imu(spec, interval_s, 1);
    constexpr std::int64_t kLate_ns = 1'000'000'000'000'000;
    const ImuTruth truth = imu.truth(motions::Circle(1.0, 0.5), 12, kLate_ns, kLate_ns + interval_ns);
    EXPECT_NEAR(truth.means.angular_rad_s.z(), 0.5, 1e-12);
    const ImuReading reading = imu.read(truth, 12, interval_ns);
    EXPECT_NEAR(reading.angular_covariance[0] * interval_s, 1e-6, 1e-18);
    EXPECT_LT(std::abs(reading.angular_rad_s.z() - 0.5), 6.0 * std::sqrt(reading.angular_covariance[5]));
  }
}

TEST(ImuSensor, RefusesBadInput) {
  const auto refusal = [](const std::function<void(ImuSensorSpec&)>& change,
                          double interval_s = kInterval_s) -> std::string {
    ImuSensorSpec spec = perfect_imu();
    spec.name = "wrist";
    change(spec);
    try {
      const ImuSensor imu(spec, interval_s, 1);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kBadInput);
      return error.what();
    }
    return "";
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find("wrist") != std::string::npos && text.find(part) != std::string::npos;
  };
  EXPECT_NE(refusal([](ImuSensorSpec& s) { s.name.clear(); }).find("name"), std::string::npos);
  EXPECT_PRED2(has, refusal([](ImuSensorSpec& s) { s.gravity_m_s2 = -9.8; }), "gravity_m_s2");
  EXPECT_PRED2(has, refusal([](ImuSensorSpec& s) { s.T_body_sensor.t.x() = INFINITY; }), "T_body_sensor");
  EXPECT_PRED2(has, refusal([](ImuSensorSpec& s) { s.gyro.noise = -1.0; }), "gyro.noise");
  EXPECT_PRED2(has, refusal([](ImuSensorSpec& s) { s.accelerometer.walk = std::nan(""); }),
               "accelerometer.walk");
  EXPECT_PRED2(has, refusal([](ImuSensorSpec& s) { s.gyro.bias.y() = INFINITY; }), "gyro.bias");
  EXPECT_PRED2(has, refusal([](ImuSensorSpec& s) { s.gyro.bias_sigma = INFINITY; }), "gyro.bias_sigma");
  EXPECT_PRED2(has, refusal([](ImuSensorSpec& s) { s.gyro.scale_sigma = 0.2; }), "gyro.scale_sigma");
  EXPECT_PRED2(has, refusal([](ImuSensorSpec& s) { s.gyro.misalignment_rad = -0.1; }),
               "gyro.misalignment_rad");
  EXPECT_PRED2(has, refusal([](ImuSensorSpec& s) { s.accelerometer.limit = 0.0; }), "accelerometer.limit");
  EXPECT_PRED2(has, refusal([](ImuSensorSpec& s) { s.accelerometer.resolution = std::nan(""); }),
               "accelerometer.resolution");
  EXPECT_PRED2(has, refusal([](ImuSensorSpec& s) { s.gyro.axes = s.accelerometer.axes = {}; }), "axes");
  EXPECT_PRED2(has, refusal([](ImuSensorSpec&) {}, 0.0), "interval");
  const ImuSensor imu(perfect_imu(), kInterval_s, 1);
  EXPECT_THROW(imu.read(some_truth(), 0, 0), Error);
  EXPECT_THROW(imu.read(some_truth(Vec3(std::nan(""), 0.0, 0.0)), 0, kInterval_ns), Error);
}

}  // namespace
}  // namespace hallway::sense
