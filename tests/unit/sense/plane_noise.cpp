// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "unit/sense/plane_fixture.hpp"

namespace hallway::sense {
namespace {

using test::observe;
using test::plan_of;
using test::plane_camera;
using test::standing;

constexpr std::uint32_t kSteps = 20'000;
constexpr std::size_t kKinds = 4;

/// Errors of one plane over their standard deviations: distance, angle, left end, right end.
using Deviates = std::array<double, kKinds>;

PlaneSensorSpec noisy() {
  PlaneSensorSpec spec = plane_camera();
  spec.noise_m = 0.02;
  spec.noise_angle = 0.005;
  spec.noise_end_m = 0.03;
  return spec;
}

/// Two walls of which all is seen.
WallPlan two_walls() {
  return plan_of({{{5, 3}, {6, -0.5}}, {{7, -1}, {5, -4}}});
}

/// What has been done to the plane of a wall, from what came out: the middle of the wall went along its true normal, the plane turned
/// about it, the ends then moved along the plane.
Deviates deviates_of(const PlaneObservation& plane, const Wall& wall, const PlaneSensorSpec& spec) {
  const Vec2 middle = 0.5 * (wall.left + wall.right), along = (wall.right - wall.left).normalized();
  const Vec2 seen_normal = plane.plane.normal.head<2>(), seen_along(-seen_normal.y(), seen_normal.x());
  const double distance_m = (plane.plane.offset - seen_normal.dot(middle)) / seen_normal.dot(wall.normal());
  const Vec2 moved = middle + distance_m * wall.normal();
  const double angle =
      std::atan2(along.x() * seen_along.y() - along.y() * seen_along.x(), along.dot(seen_along));
  const double half_m = 0.5 * wall.length_m();
  return {distance_m / spec.noise_m, angle / spec.noise_angle,
          (seen_along.dot(plane.corners[0].head<2>() - moved) + half_m) / spec.noise_end_m,
          (seen_along.dot(plane.corners[1].head<2>() - moved) - half_m) / spec.noise_end_m};
}

class PlaneNoise : public testing::Test {
 protected:
  PlaneNoise() : plan_(two_walls()), all_(2, std::vector<Deviates>(kSteps)) {
    const PlaneSensor sensor(noisy(), plan_, 42);
    for (std::uint32_t step = 0; step < kSteps; ++step) {
      for (const PlaneObservation& plane : observe(sensor, standing(), step))
        all_[plane.true_plane][step] = deviates_of(plane, plan_.walls[plane.true_plane], noisy());
    }
  }

  template <typename Function>
  double mean(const Function& of) const {
    double sum = 0.0;
    for (const auto& wall : all_) {
      for (const Deviates& deviates : wall) sum += of(deviates);
    }
    return sum / kCount;
  }

  static constexpr double kCount = 2.0 * kSteps;
  WallPlan plan_;
  std::vector<std::vector<Deviates>> all_;  ///< by wall and step
};

TEST_F(PlaneNoise, HasNoBiasAndTheSigmaOfEachKind) {
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    EXPECT_NEAR(mean([&](const Deviates& d) { return d[kind]; }), 0.0, 4.0 / std::sqrt(kCount)) << kind;
    EXPECT_NEAR(mean([&](const Deviates& d) { return d[kind] * d[kind]; }), 1.0,
                4.0 * std::sqrt(2.0 / kCount))
        << kind;
  }
}

TEST_F(PlaneNoise, IsGaussian) {
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    for (const double bound : {0.5, 1.0, 2.0, 3.0}) {
      const double expected = std::erf(bound / std::sqrt(2.0));
      const double share = mean([&](const Deviates& d) { return std::abs(d[kind]) < bound ? 1.0 : 0.0; });
      EXPECT_NEAR(share, expected, 4.0 * std::sqrt(expected * (1.0 - expected) / kCount))
          << kind << " " << bound;
    }
  }
}

TEST_F(PlaneNoise, IsIndependentBetweenKinds) {
  for (std::size_t a = 0; a < kKinds; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      EXPECT_NEAR(mean([&](const Deviates& d) { return d[a] * d[b]; }), 0.0, 4.0 / std::sqrt(kCount))
          << a << " " << b;
    }
  }
}

TEST_F(PlaneNoise, IsIndependentBetweenStepsAndWalls) {
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    double steps = 0.0, walls = 0.0;
    for (std::size_t i = 0; i + 1 < kSteps; ++i) {
      steps += all_[0][i][kind] * all_[0][i + 1][kind];
      walls += all_[0][i][kind] * all_[1][i][kind];
    }
    EXPECT_NEAR(steps / kSteps, 0.0, 4.0 / std::sqrt(kSteps)) << kind;
    EXPECT_NEAR(walls / kSteps, 0.0, 4.0 / std::sqrt(kSteps)) << kind;
  }
}

TEST_F(PlaneNoise, LeavesUprightRectanglesOnTheirPlanes) {
  const PlaneSensor sensor(noisy(), plan_, 42);
  for (std::uint32_t step = 0; step < 100; ++step) {
    for (const PlaneObservation& plane : observe(sensor, standing(), step)) {
      EXPECT_NEAR(plane.plane.normal.norm(), 1.0, 1e-12);
      EXPECT_EQ(plane.plane.normal.z(), 0.0);
      EXPECT_LT(plane.plane.offset, 0.0);
      EXPECT_NEAR(plane.plane.distance(plane.centroid), 0.0, 1e-12);
      for (const Vec3& corner : plane.corners) EXPECT_NEAR(plane.plane.distance(corner), 0.0, 1e-12);
      const auto& c = plane.corners;
      EXPECT_GT((c[1] - c[0]).cross(c[3] - c[0]).dot(plane.plane.normal), 0.0);
      EXPECT_EQ(c[0].z(), -test::kEye_m);
      EXPECT_EQ(c[2].z(), 3.0 - test::kEye_m);
      EXPECT_LT((c[1] + c[3] - c[0] - c[2]).norm(), 1e-12);
    }
  }
}

TEST_F(PlaneNoise, DependsOnSeedAndNameAndStepAlone) {
  const auto first = [&](const PlaneSensorSpec& spec, std::uint64_t seed, const WallPlan& plan) {
    Deviates found{};
    for (const PlaneObservation& plane : observe(PlaneSensor(spec, plan, seed), standing())) {
      if (plane.true_plane == 0) found = deviates_of(plane, plan.walls[0], spec);
    }
    return found;
  };
  PlaneSensorSpec renamed = noisy();
  renamed.name = "other";
  EXPECT_EQ(first(noisy(), 42, plan_), all_[0][0]);
  EXPECT_NE(first(noisy(), 43, plan_), all_[0][0]);
  EXPECT_NE(first(renamed, 42, plan_), all_[0][0]);
  EXPECT_NE(all_[0][1], all_[0][0]);
  // What else is seen does not matter.
  EXPECT_EQ(first(noisy(), 42, plan_of({{plan_.walls[0].left, plan_.walls[0].right}})), all_[0][0]);
}

TEST(PlaneNoiseAtTheBorder, DecidesNothing) {
  // Just inside and just outside of the range; noise of 1 m would carry half of them over.
  std::vector<test::WallEnds> walls;
  for (int i = 0; i < 20; ++i) {
    const double x = i < 10 ? 11.99 : 12.01, y = i % 10 - 5;
    walls.push_back({{x, y + 0.9}, {x, y}});
  }
  const WallPlan plan = plan_of(walls);
  PlaneSensorSpec spec = plane_camera();
  spec.noise_m = 1.0;
  const PlaneSensor sensor(spec, plan, 1);
  for (std::uint32_t step = 0; step < 20; ++step) {
    const auto planes = observe(sensor, standing(), step);
    ASSERT_EQ(planes.size(), 10u);
    for (const PlaneObservation& plane : planes) ASSERT_LT(plane.true_plane, 10u);
  }
}

TEST(PlaneNoiseBeyondMeasure, LeavesOutWhatIsNoPlaneAnyMore) {
  // A wall 1 m ahead, 1 m long, with noise of metres: what is left faces the sensor and has a length.
  const WallPlan plan = plan_of({{{1, 0.5}, {1, -0.5}}});
  PlaneSensorSpec spec = plane_camera();
  spec.noise_m = 2.0;
  spec.noise_end_m = 2.0;
  const PlaneSensor sensor(spec, plan, 3);
  std::size_t given = 0;
  for (std::uint32_t step = 0; step < 1000; ++step) {
    for (const PlaneObservation& plane : observe(sensor, standing(), step)) {
      ++given;
      ASSERT_LE(plane.plane.offset, 0.0);
      ASSERT_GT((plane.corners[1] - plane.corners[0]).norm(), 0.0);
    }
  }
  EXPECT_GT(given, 200u);
  EXPECT_LT(given, 800u);
}

TEST(PlaneOrder, SaysNothingOfIdentity) {
  std::vector<test::WallEnds> walls;
  for (int i = 0; i < 100; ++i) walls.push_back({{10, 5 - 0.1 * i}, {10, 4.92 - 0.1 * i}});
  const WallPlan plan = plan_of(walls);
  const PlaneSensor sensor(plane_camera(), plan, 1);
  const auto order = [&](std::uint32_t step) {
    std::vector<std::uint32_t> found;
    for (const PlaneObservation& plane : observe(sensor, standing(), step)) found.push_back(plane.true_plane);
    return found;
  };
  EXPECT_EQ(order(0), order(0));
  EXPECT_NE(order(0), order(1));
  double mean_place_of_first_half = 0.0;
  for (std::uint32_t step = 0; step < 100; ++step) {
    const auto found = order(step);
    ASSERT_EQ(found.size(), 100u);
    for (std::size_t place = 0; place < 100; ++place) {
      if (found[place] < 50) mean_place_of_first_half += static_cast<double>(place) / 5000.0;
    }
  }
  EXPECT_NEAR(mean_place_of_first_half, 49.5, 2.0);  // the standard deviation of this mean is 0.29
}

}  // namespace
}  // namespace hallway::sense
