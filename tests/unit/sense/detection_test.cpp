// SPDX-License-Identifier: MIT
#include "sense/detection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "sense/face_sensor.hpp"
#include "support/errors.hpp"
#include "unit/sense/plane_fixture.hpp"
#include "unit/sense/sensor_fixture.hpp"

namespace hallway::sense {
namespace {

constexpr double kStandardErrors = 3.0;
constexpr std::uint32_t kReadings = 4000;

/// That of a share of n.
double error_of_share(double share, double n) {
  return std::sqrt(share * (1.0 - share) / n);
}

std::vector<Vec3> thirty_ahead() {
  std::vector<Vec3> landmarks;
  for (int i = 0; i < 30; ++i) landmarks.push_back({10.0, 0.2 * i - 3.0, 0.0});
  return landmarks;
}

using Points = std::vector<PointObservation>;

/// All readings of a sensor that sees thirty points.
std::vector<Points> readings(const PointSensorSpec& spec, std::uint32_t n, std::uint64_t seed = 5) {
  const std::vector<Vec3> landmarks = thirty_ahead();
  const LandmarkIndex index(landmarks);
  const PointSensor sensor(spec, index, test::empty_scene(), seed);
  std::vector<Points> all;
  for (std::uint32_t k = 0; k < n; ++k) all.push_back(test::observe(sensor, Pose(), k));
  return all;
}

PointSensorSpec noisy_camera() {
  PointSensorSpec spec = test::camera();
  spec.noise_m = Vec3(0.1, 0.1, 0.1);
  return spec;
}

TEST(PoissonQuantile, InvertsTheDistributionFunction) {
  for (const double mean : {0.01, 1.0, 7.5, kMostClutter}) {
    double share = 0.0;
    for (std::uint32_t k = 0; k < 4 * static_cast<std::uint32_t>(mean) + 20; ++k) {
      const double p = std::exp(k * std::log(mean) - mean - std::lgamma(k + 1.0));
      if (p > 1e-6 && share < 1.0 - 1e-6) {
        EXPECT_EQ(poisson_quantile(share + 0.5 * p, mean), k) << mean;
      }
      share += p;
    }
  }
  EXPECT_EQ(poisson_quantile(0.0, 0.0), 0u);
  EXPECT_LT(poisson_quantile(std::nextafter(1.0, 0.0), kMostClutter), 1500u);
}

TEST(Dropout, ShareIsThatDeclaredAndReadingsAreIndependent) {
  PointSensorSpec spec = test::camera();
  spec.detection.dropout = 0.2;
  const auto all = readings(spec, kReadings);
  std::vector<std::array<bool, 30>> seen(kReadings);
  double total = 0.0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    seen[k].fill(false);
    for (const PointObservation& one : all[k]) seen[k].at(one.landmark) = true;
    total += static_cast<double>(all[k].size());
  }
  const double n = 30.0 * kReadings;
  EXPECT_NEAR(total / n, 0.8, kStandardErrors * error_of_share(0.8, n));
  // Both of two neighbours, in a reading and in two readings.
  double beside = 0.0, after = 0.0;
  for (std::size_t k = 0; k + 1 < kReadings; ++k) {
    for (std::size_t i = 0; i + 1 < 30; ++i) {
      beside += seen[k][i] && seen[k][i + 1] ? 1.0 : 0.0;
      after += seen[k][i] && seen[k + 1][i] ? 1.0 : 0.0;
    }
  }
  const double pairs = 29.0 * (kReadings - 1);
  // Pairs that share an element are correlated: at most three times the variance of independent ones.
  const double error = std::sqrt(3.0) * error_of_share(0.64, pairs);
  EXPECT_NEAR(beside / pairs, 0.64, kStandardErrors * error);
  EXPECT_NEAR(after / pairs, 0.64, kStandardErrors * error);
}

TEST(Dropout, LeavesTheOthersAsTheyAre) {
  PointSensorSpec spec = noisy_camera();
  const auto whole = readings(spec, 20);
  spec.detection.dropout = 0.3;
  const auto rest = readings(spec, 20);
  for (std::size_t k = 0; k < whole.size(); ++k) {
    ASSERT_LT(rest[k].size(), whole[k].size());
    auto at = whole[k].begin();
    for (const PointObservation& one : rest[k]) {  // in the same order
      at =
          std::find_if(at, whole[k].end(), [&](const auto& other) { return other.landmark == one.landmark; });
      ASSERT_NE(at, whole[k].end());
      EXPECT_EQ(at->point, one.point);
    }
  }
}

TEST(Dropout, OfOneLosesAll) {
  PointSensorSpec spec = test::camera();
  spec.detection.dropout = 1.0;
  for (const Points& reading : readings(spec, 20)) EXPECT_TRUE(reading.empty());
}

TEST(Clutter, CountsArePoisson) {
  PointSensorSpec spec = noisy_camera();
  spec.detection.clutter = 2.5;
  const auto all = readings(spec, kReadings);
  double sum = 0.0, squares = 0.0;
  for (const Points& reading : all) {
    const auto n = static_cast<double>(
        std::ranges::count(reading, PointObservation::kFalse, &PointObservation::landmark));
    sum += n;
    squares += (n - 2.5) * (n - 2.5);
  }
  // The fourth central moment of Poisson's distribution is m + 3 m^2.
  EXPECT_NEAR(sum / kReadings, 2.5, kStandardErrors * std::sqrt(2.5 / kReadings));
  EXPECT_NEAR(squares / kReadings, 2.5, kStandardErrors * std::sqrt((2.5 + 2.0 * 2.5 * 2.5) / kReadings));
}

/// Expects numbers of [0, 1] whose mean, variance and share below each tenth are those of a uniform distribution.
void expect_uniform(const std::vector<double>& values, const char* what) {
  const auto n = static_cast<double>(values.size());
  ASSERT_GT(n, 1000.0) << what;
  for (int tenth = 1; tenth < 10; ++tenth) {
    const double bound = 0.1 * tenth;
    const auto below = std::ranges::count_if(values, [&](double value) { return value < bound; });
    EXPECT_NEAR(static_cast<double>(below) / n, bound, 1.2 * kStandardErrors * error_of_share(bound, n))
        << what << " below " << bound;
  }
}

TEST(Clutter, FillsACamerasImageAndRange) {
  PointSensorSpec spec = test::camera();
  spec.min_range_m = 2.0;
  spec.max_range_m = 12.0;
  spec.detection.clutter = 10.0;
  std::vector<double> across, up, range;
  for (const Points& reading : readings(spec, 500)) {
    for (const PointObservation& one : reading) {
      if (one.landmark != PointObservation::kFalse) continue;
      across.push_back(0.5 + 0.5 * one.point.y() / one.point.x() / std::tan(0.5 * spec.horizontal_fov));
      up.push_back(0.5 + 0.5 * one.point.z() / one.point.x() / std::tan(0.5 * spec.vertical_fov));
      range.push_back((one.point.norm() - 2.0) / 10.0);
    }
  }
  expect_uniform(across, "across");
  expect_uniform(up, "up");
  expect_uniform(range, "range");
}

TEST(Clutter, FillsAllDirectionsOfAScanner) {
  PointSensorSpec spec = test::camera();
  spec.horizontal_fov = 2.0 * std::numbers::pi;
  spec.vertical_fov = 1.0;
  spec.max_range_m = 10.0;
  spec.detection.clutter = 10.0;
  const FieldOfView view(spec.horizontal_fov, spec.vertical_fov, 0.0, 10.0);
  std::vector<double> azimuth, sine;
  for (const Points& reading : readings(spec, 500)) {
    for (const PointObservation& one : reading) {
      if (one.landmark != PointObservation::kFalse) continue;
      EXPECT_TRUE(view.contains(one.point));
      azimuth.push_back(0.5 + 0.5 * std::atan2(one.point.y(), one.point.x()) / std::numbers::pi);
      sine.push_back(0.5 + 0.5 * one.point.normalized().z() / std::sin(0.5));
    }
  }
  expect_uniform(azimuth, "azimuth");
  expect_uniform(sine, "sine of the elevation");
}

TEST(Clutter, LeavesTheOthersAsTheyAre) {
  PointSensorSpec spec = noisy_camera();
  const auto plain = readings(spec, 20);
  spec.detection.clutter = 8.0;
  auto cluttered = readings(spec, 20);
  bool mixed = false;
  for (std::size_t k = 0; k < plain.size(); ++k) {
    mixed = mixed || cluttered[k].front().landmark == PointObservation::kFalse;
    std::erase_if(cluttered[k], [](const auto& one) { return one.landmark == PointObservation::kFalse; });
    ASSERT_EQ(cluttered[k].size(), plain[k].size());
    for (std::size_t i = 0; i < plain[k].size(); ++i) {
      EXPECT_EQ(cluttered[k][i].landmark, plain[k][i].landmark);
      EXPECT_EQ(cluttered[k][i].point, plain[k][i].point);
    }
  }
  EXPECT_TRUE(mixed);
}

TEST(Clutter, DependsOnSeedAndNameAndNotOnThreads) {
  PointSensorSpec spec = test::camera();
  spec.detection.clutter = 50.0;
  const auto places = [](const Points& reading) {
    std::set<double> ranges;
    for (const PointObservation& one : reading) {
      if (one.landmark == PointObservation::kFalse) ranges.insert(one.point.norm());
    }
    return ranges;
  };
  const auto one = places(readings(spec, 1).front());
  EXPECT_EQ(one, places(readings(spec, 1).front()));
  EXPECT_NE(one, places(readings(spec, 1, 6).front()));
  PointSensorSpec renamed = spec;
  renamed.name = "other";
  EXPECT_NE(one, places(readings(renamed, 1).front()));
  const std::vector<Vec3> landmarks = thirty_ahead();
  const LandmarkIndex index(landmarks);
  const PointSensor sensor(spec, index, test::empty_scene(), 5);
  const Points once = test::observe(sensor, Pose(), 0, 1), four = test::observe(sensor, Pose(), 0, 4);
  ASSERT_EQ(once.size(), four.size());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].point, four[i].point);
}

/// A plane as the ABI demands it: unit normal towards the sensor, corners counter-clockwise on it.
void expect_plane(const PlaneObservation& plane) {
  EXPECT_NEAR(plane.plane.normal.norm(), 1.0, 1e-12);
  EXPECT_LE(plane.plane.offset, 0.0);
  for (const Vec3& corner : plane.corners)
    EXPECT_NEAR(plane.plane.normal.dot(corner), plane.plane.offset, 1e-9);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 way = plane.corners.at((i + 1) % 4) - plane.corners.at(i);
    const Vec3 next = plane.corners.at((i + 2) % 4) - plane.corners.at((i + 1) % 4);
    EXPECT_GT(way.cross(next).dot(plane.plane.normal), 0.0);
  }
}

/// The middle of a false plane in the image, and its depth or range as a share of what may be.
struct Middles {
  std::vector<double> across, range;
  double false_planes = 0.0, true_planes = 0.0;
};

template <typename Sensor>
Middles middles(const Sensor& sensor, const Pose& pose, bool depths) {
  const PlaneSensorSpec& spec = sensor.spec();
  Middles found;
  std::vector<PlaneObservation> planes;
  for (std::uint32_t k = 0; k < kReadings; ++k) {
    sensor.observe(pose, k, planes);
    for (const PlaneObservation& plane : planes) {
      const bool is_false = plane.true_plane == PlaneObservation::kNoPlane;
      (is_false ? found.false_planes : found.true_planes) += 1.0;
      if (!is_false) continue;
      expect_plane(plane);
      const Vec3& at = plane.centroid;
      const double angle = std::acos(std::clamp(-plane.plane.normal.dot(at.normalized()), -1.0, 1.0));
      EXPECT_LE(angle, std::numbers::pi / 3.0 + 1e-9);
      found.across.push_back(depths ? 0.5 + 0.5 * at.y() / at.x() / std::tan(0.5 * spec.view.horizontal_fov)
                                    : 0.5 + std::atan2(at.y(), at.x()) / spec.view.horizontal_fov);
      found.range.push_back(((depths ? at.x() : at.norm()) - spec.view.min_range_m) /
                            (spec.view.max_range_m - spec.view.min_range_m));
    }
  }
  return found;
}

void expect_detection(const Middles& found, double seen, const DetectionSpec& spec) {
  expect_uniform(found.across, "across");
  expect_uniform(found.range, "range");
  const double n = kReadings;
  EXPECT_NEAR(found.false_planes / n, spec.clutter, kStandardErrors * std::sqrt(spec.clutter / n));
  EXPECT_NEAR(found.true_planes / (seen * n), 1.0 - spec.dropout,
              kStandardErrors * error_of_share(spec.dropout, seen * n));
}

TEST(PlaneDetection, WallsAreMissedAndFalseAsDeclared) {
  const WallPlan plan = test::plan_of({{{5, 3}, {6, -0.5}}, {{7, -1}, {5, -4}}});
  PlaneSensorSpec spec = test::plane_camera();
  spec.view.min_range_m = 1.0;
  spec.detection = {.dropout = 0.3, .clutter = 1.5};
  expect_detection(middles(PlaneSensor(spec, plan, 3), test::standing(), true), 2.0, spec.detection);
  spec.view.horizontal_fov = 2.0 * std::numbers::pi;
  expect_detection(middles(PlaneSensor(spec, plan, 3), test::standing(), false), 2.0, spec.detection);
}

TEST(PlaneDetection, FacesAreMissedAndFalseAsDeclared) {
  Polygon board;
  board.vertices = {{4, 1, -0.5}, {4, -1, -0.5}, {4, -1, 0.5}, {4, 1, 0.5}};
  board.plane = {-Vec3::UnitX(), -4.0};
  const FacePlan plan{{board}, {board}};
  PlaneSensorSpec spec;
  spec.name = "eyes";
  spec.shape = PlaneShape::faces;
  spec.view.max_range_m = 8.0;
  spec.detection = {.dropout = 0.3, .clutter = 1.5};
  expect_detection(middles(FaceSensor(spec, plan, 3), Pose(), true), 1.0, spec.detection);
}

TEST(DetectionSpec, RefusesWhatIsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string name = "eyes";  // which the check refers to
  const SpecCheck check(name);
  for (const double bad : {-0.1, 1.5, nan}) {
    const auto error = test::error_of([&] { check_detection(check, {.dropout = bad}); });
    ASSERT_TRUE(error) << bad;
    EXPECT_TRUE(error->message().starts_with("dropout is")) << error->message();
  }
  for (const double bad : {-0.1, 500.5, nan}) {
    const auto error = test::error_of([&] { check_detection(check, {.clutter = bad}); });
    ASSERT_TRUE(error) << bad;
    EXPECT_TRUE(error->message().starts_with("clutter is")) << error->message();
  }
}

}  // namespace
}  // namespace hallway::sense
