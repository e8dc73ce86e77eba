// SPDX-License-Identifier: MIT
#include "eval/point_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "random_motion.hpp"

namespace hallway::eval {
namespace {

using Points = std::vector<Vec3>;

constexpr double kRounding = 1e-9;  // of coordinates up to 200 m

Points moved(const Pose& motion, const Points& points) {
  Points result;
  for (const Vec3& point : points) result.push_back(motion * point);
  return result;
}

TEST(Rmse, IsTheRootOfTheMeanOfTheSquares) {
  const Points truth = {{0, 0, 0}, {1, 0, 0}};
  const Points estimate = {{0, 3, 4}, {1, 0, 0}};
  EXPECT_DOUBLE_EQ(*rmse(truth, estimate, Pose{}), std::sqrt(25.0 / 2.0));
}

TEST(Rmse, PutsTheEstimateIntoTheWorldFirst) {
  const Pose quarter_turn{from_yaw_pitch_roll(std::numbers::pi / 2, 0, 0), {10, 0, 0}};
  EXPECT_NEAR(*rmse(Points{{10, 1, 0}}, Points{{1, 0, 0}}, quarter_turn), 0.0, kRounding);
}

TEST(Rmse, OfNothingIsUnknown) {
  EXPECT_FALSE(rmse({}, {}, Pose{}));
}

TEST(AlignedRmse, NeedsThreePoints) {
  const Points points = random_points(3, 1);
  for (std::size_t count = 0; count < 3; ++count) {
    EXPECT_FALSE(aligned_rmse(std::span(points).first(count), std::span(points).first(count))) << count;
  }
  EXPECT_NEAR(*aligned_rmse(points, points), 0.0, kRounding);
}

TEST(AlignedRmse, RemovesARigidMotion) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Points points = random_points(40, seed);
    EXPECT_NEAR(*aligned_rmse(points, moved(random_motion(seed), points)), 0.0, kRounding) << seed;
  }
}

TEST(AlignedRmse, DoesNotDependOnWhereTheMapStands) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Points truth = random_points(40, seed);
    Points estimate = truth;
    const Points noise = random_points(40, seed + 1000);
    for (std::size_t i = 0; i < truth.size(); ++i) estimate[i] += 0.01 * noise[i];
    const double expected = *aligned_rmse(truth, estimate);
    EXPECT_GT(expected, 0.1);
    EXPECT_NEAR(*aligned_rmse(truth, moved(random_motion(seed), estimate)), expected, kRounding) << seed;
    EXPECT_NEAR(*aligned_rmse(moved(random_motion(seed), truth), estimate), expected, kRounding) << seed;
  }
}

TEST(AlignedRmse, IsNeverAboveAnyOtherPlacement) {
  const Points truth = random_points(30, 5);
  const Points estimate = random_points(30, 6);
  const double best = *aligned_rmse(truth, estimate);
  for (std::uint32_t step = 0; step < 200; ++step) {
    EXPECT_LE(best, *rmse(truth, estimate, random_motion(7, step)) + kRounding);
  }
}

TEST(AlignedRmse, KeepsAnErrorOfScale) {
  const Points truth = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}};
  Points twice = truth;
  for (Vec3& point : twice) point *= 2.0;
  EXPECT_NEAR(*aligned_rmse(truth, twice), 1.0, kRounding);
}

TEST(AlignedRmse, DoesNotMirror) {
  const Points truth = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
  Points mirrored = truth;
  for (Vec3& point : mirrored) point.x() = -point.x();
  EXPECT_GT(*aligned_rmse(truth, mirrored), 0.1);
}

TEST(AlignedRmse, FitsCollinearPoints) {
  Points truth;
  for (int i = 0; i < 10; ++i) truth.emplace_back(i, 2.0 * i, 0.0);
  EXPECT_NEAR(*aligned_rmse(truth, moved(random_motion(3), truth)), 0.0, kRounding);
}

TEST(AlignedRmse, FitsCoincidentPoints) {
  const Points truth(5, Vec3(1, 2, 3));
  const Points estimate(5, Vec3(-4, 0, 9));
  EXPECT_NEAR(*aligned_rmse(truth, estimate), 0.0, kRounding);
}

}  // namespace
}  // namespace hallway::eval
