// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "unit/sense/sensor_fixture.hpp"

namespace hallway::sense {
namespace {

using test::camera;
using test::empty_scene;
using test::observe;

/// Landmarks on a grid ahead, all in view.
std::vector<Vec3> grid() {
  std::vector<Vec3> landmarks;
  for (int y = -10; y < 10; ++y) {
    for (int z = -5; z < 5; ++z) landmarks.push_back({20.0, 0.9 * y, 0.9 * z});
  }
  return landmarks;
}

/// Error of each observation over its standard deviation, by step and landmark.
std::vector<std::vector<Vec3>> deviates(const PointSensor& sensor, const std::vector<Vec3>& landmarks,
                                        std::uint32_t steps) {
  std::vector<std::vector<Vec3>> all(steps, std::vector<Vec3>(landmarks.size()));
  for (std::uint32_t step = 0; step < steps; ++step) {
    for (const auto& observation : observe(sensor, Pose(), step)) {
      const Vec3 error = observation.point - landmarks[observation.landmark];
      all[step][observation.landmark] = error.cwiseQuotient(sensor.spec().noise_m);
    }
  }
  return all;
}

class PointNoise : public testing::Test {
 protected:
  static constexpr std::uint32_t kSteps = 200;
  PointNoise() : landmarks_(grid()), index_(landmarks_), sensor_(spec(), index_, empty_scene(), 42) {
    all_ = deviates(sensor_, landmarks_, kSteps);
    count_ = static_cast<double>(kSteps) * static_cast<double>(landmarks_.size());  // 40 000
  }
  static PointSensorSpec spec() {
    PointSensorSpec spec = camera();
    spec.noise_m = Vec3(0.05, 0.2, 0.01);
    return spec;
  }
  template <typename Function>
  double mean(const Function& of) const {
    double sum = 0.0;
    for (const auto& step : all_) {
      for (const Vec3& deviate : step) sum += of(deviate);
    }
    return sum / count_;
  }

  std::vector<Vec3> landmarks_;
  LandmarkIndex index_;
  PointSensor sensor_;
  std::vector<std::vector<Vec3>> all_;
  double count_ = 0.0;
};

TEST_F(PointNoise, HasNoBiasAndTheSigmaOfEachAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(mean([&](const Vec3& d) { return d[axis]; }), 0.0, 4.0 / std::sqrt(count_)) << axis;
    EXPECT_NEAR(mean([&](const Vec3& d) { return d[axis] * d[axis]; }), 1.0, 4.0 * std::sqrt(2.0 / count_))
        << axis;
  }
}

TEST_F(PointNoise, IsGaussian) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double bound : {0.5, 1.0, 2.0, 3.0}) {
      const double expected = std::erf(bound / std::sqrt(2.0));
      const double share = mean([&](const Vec3& d) { return std::abs(d[axis]) < bound ? 1.0 : 0.0; });
      EXPECT_NEAR(share, expected, 4.0 * std::sqrt(expected * (1.0 - expected) / count_))
          << axis << " " << bound;
    }
  }
}

TEST_F(PointNoise, IsIndependentBetweenAxes) {
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3;
    EXPECT_NEAR(mean([&](const Vec3& d) { return d[axis] * d[next]; }), 0.0, 4.0 / std::sqrt(count_)) << axis;
    EXPECT_NEAR(mean([&](const Vec3& d) { return (d[axis] * d[axis] - 1.0) * (d[next] * d[next] - 1.0); }),
                0.0, 4.0 * 2.0 / std::sqrt(count_));
  }
}

TEST_F(PointNoise, IsIndependentBetweenStepsAndLandmarks) {
  double between_steps = 0.0;
  double between_landmarks = 0.0;
  for (std::size_t step = 0; step + 1 < kSteps; ++step) {
    for (std::size_t i = 0; i + 1 < landmarks_.size(); ++i) {
      between_steps += all_[step][i].dot(all_[step + 1][i]);
      between_landmarks += all_[step][i].dot(all_[step][i + 1]);
    }
  }
  EXPECT_NEAR(between_steps / count_, 0.0, 4.0 * std::sqrt(3.0 / count_));
  EXPECT_NEAR(between_landmarks / count_, 0.0, 4.0 * std::sqrt(3.0 / count_));
}

TEST_F(PointNoise, DependsOnSeedAndNameAndNothingElse) {
  const auto other_seed =
      deviates(PointSensor(spec(), LandmarkIndex(landmarks_), empty_scene(), 43), landmarks_, 1);
  PointSensorSpec renamed = spec();
  renamed.name = "other";
  const auto other_name =
      deviates(PointSensor(renamed, LandmarkIndex(landmarks_), empty_scene(), 42), landmarks_, 1);
  const auto same =
      deviates(PointSensor(spec(), LandmarkIndex(landmarks_), empty_scene(), 42), landmarks_, 1);
  EXPECT_EQ(same[0], all_[0]);
  EXPECT_NE(other_seed[0][0], all_[0][0]);
  EXPECT_NE(other_name[0][0], all_[0][0]);
}

TEST_F(PointNoise, IsTheLandmarksOwnWhateverElseIsSeen) {
  std::vector<Vec3> fewer(landmarks_.begin(), landmarks_.begin() + 5);
  const auto alone = deviates(PointSensor(spec(), LandmarkIndex(fewer), empty_scene(), 42), fewer, 1);
  for (std::size_t i = 0; i < fewer.size(); ++i) EXPECT_EQ(alone[0][i], all_[0][i]);
}

TEST(PointWithoutNoise, IsExact) {
  const std::vector<Vec3> landmarks = grid();
  const LandmarkIndex index(landmarks);
  const PointSensor sensor(camera(), index, empty_scene(), 42);
  for (const auto& observation : observe(sensor, Pose())) {
    EXPECT_EQ(observation.point, landmarks[observation.landmark]);
  }
}

TEST(PointNoiseOverDistance, GrowsAsItIsSaid) {
  // The same deviates as without growth, each times what stands in the specification at that distance.
  const std::vector<Vec3> landmarks{{1.0, 0.0, 0.0}, {3.0, 0.0, 4.0}, {80.0, 0.0, 0.0}};
  const LandmarkIndex index(landmarks);
  PointSensorSpec plain = camera();
  plain.vertical_fov = 2.0;
  plain.noise_m = Vec3(1, 1, 1);
  PointSensorSpec growing = plain;
  growing.noise_m = Vec3(0.1, 0.2, 0.0);
  growing.noise_per_m = Vec3(0.01, 0.0, 0.02);
  const PointSensor unit(plain, index, empty_scene(), 7);
  const PointSensor sensor(growing, index, empty_scene(), 7);
  const auto one = observe(unit, Pose(), 3), other = observe(sensor, Pose(), 3);
  ASSERT_EQ(one.size(), 3u);
  ASSERT_EQ(other.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(one[i].landmark, other[i].landmark);
    const Vec3& truth = landmarks[one[i].landmark];
    const double range_m = one[i].landmark == 0 ? 1.0 : one[i].landmark == 1 ? 5.0 : 80.0;
    const Vec3 sigma(std::hypot(0.1, 0.01 * range_m), 0.2, 0.02 * range_m);
    EXPECT_LT((other[i].point - truth - sigma.cwiseProduct(one[i].point - truth)).norm(), 1e-12);
  }
}

TEST(PointNoiseAtTheBorder, DecidesNothing) {
  // Just inside and just outside of the range; noise of 1 m would carry half of them over.
  std::vector<Vec3> landmarks;
  for (int i = 0; i < 40; ++i) landmarks.push_back({i < 20 ? 99.99 : 100.01, 0.0, 0.0});
  PointSensorSpec spec = camera();
  spec.noise_m = Vec3(1, 1, 1);
  const LandmarkIndex index(landmarks);
  const PointSensor sensor(spec, index, empty_scene(), 1);
  for (std::uint32_t step = 0; step < 10; ++step) {
    const auto numbers = test::seen(observe(sensor, Pose(), step));
    ASSERT_EQ(numbers.size(), 20u);
    ASSERT_EQ(numbers.back(), 19u);
  }
}

}  // namespace
}  // namespace hallway::sense
