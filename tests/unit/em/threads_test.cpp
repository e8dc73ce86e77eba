// SPDX-License-Identifier: MIT
// What threads share, and that nothing that comes out depends on how many there are.
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <stdexcept>

#include "em/core/auto_planes.hpp"
#include "em/core/canonical.hpp"
#include "unit/em/auto_scene.hpp"

namespace hallway::em {
namespace {

using namespace hallway::em::test;  // NOLINT

TEST(Workers, DoEachItemOnceHoweverManyThereAre) {
  for (const int threads : {1, 2, 3, 8}) {
    Workers workers(threads);
    EXPECT_EQ(workers.count(), static_cast<std::size_t>(threads));
    for (const std::size_t items : {0u, 1u, 2u, 7u, 1000u}) {
      std::vector<int> done(items, 0);
      workers.run(items, [&](std::size_t item, std::size_t) { ++done[item]; });
      EXPECT_EQ(done, std::vector<int>(items, 1)) << threads;
    }
  }
}

TEST(Workers, AreAFewWhereTheirNumberIsNotGiven) {
  const Workers workers(0);
  EXPECT_GE(workers.count(), 1u);
  EXPECT_LE(workers.count(), static_cast<std::size_t>(Workers::kMostOfItself));
}

TEST(Workers, NoTwoItemsOfOneWorkerRunAtATime) {
  Workers workers(4);
  std::vector<std::atomic<int>> inside(4);
  std::atomic<int> collisions = 0;
  workers.run(2000, [&](std::size_t, std::size_t worker) {
    if (inside.at(worker)++ != 0) ++collisions;
    --inside.at(worker);
  });
  EXPECT_EQ(collisions, 0);
}

TEST(Workers, TheFirstOfTheExceptionsIsThrownAndTheNextLoopRuns) {
  for (const int threads : {1, 3}) {
    Workers workers(threads);
    try {
      workers.run(100, [](std::size_t item, std::size_t) {
        if (item % 10 == 7) throw std::runtime_error("item " + std::to_string(item));
      });
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "item 7");
    }
    std::atomic<int> done = 0;
    workers.run(50, [&](std::size_t, std::size_t) { ++done; });
    EXPECT_EQ(done, 50);
  }
}

/// Enough points for several parts of every loop, some of them twice, and some that are none.
std::vector<Vec3> many_points() {
  LabelledPoints cloud;
  const Vec3 slant = Vec3(0.0, 0.8, 0.6);
  add(cloud, {{3, 3, 1}, Vec3::UnitX(), Vec3::UnitY(), 2, 2, 14000, 0.01}, 0);
  add(cloud, {{1, 3, 2}, Vec3::UnitY(), Vec3::UnitZ(), 2, 1, 9000, 0.01}, 1);
  add(cloud, {{4, 3, 2}, Vec3::UnitX(), slant, 1.5, 1.5, 9000, 0.01}, 2);
  add(cloud, {{5, 6, 5}, Vec3::UnitX(), slant, 1, 1, 5000, 0.01}, 3);
  add_outliers(cloud, 1500, 10.0, 2);
  std::vector<Vec3> points = cloud.points;
  points.insert(points.begin() + 5000, cloud.points.begin() + 100, cloud.points.begin() + 1100);
  for (const std::size_t i : {0u, 50u, 20000u}) points[i].y() = std::numeric_limits<double>::quiet_NaN();
  return points;
}

void expect_equal(const Plane& left, const Plane& right) {
  EXPECT_EQ(left.id, right.id);
  EXPECT_EQ(left.normal, right.normal);
  EXPECT_EQ(left.offset, right.offset);
  EXPECT_EQ(left.centroid, right.centroid);
  EXPECT_EQ(left.corners, right.corners);
  EXPECT_EQ(left.hull, right.hull);
  EXPECT_EQ(left.members, right.members);
  EXPECT_EQ(left.rms, right.rms);
  EXPECT_EQ(left.exclusive_share, right.exclusive_share);
}

void expect_same_for_any_number_of_threads(const std::vector<Vec3>& points) {
  AutoOptions options;
  options.threads = 1;
  const Extraction alone = PlaneExtractor(options).extract(points);
  EXPECT_GE(alone.planes.size(), 4u);
  for (const int threads : {0, 2, 5}) {
    options.threads = threads;
    const PlaneExtractor extractor(options);
    const Extraction shared = extractor.extract(points);
    EXPECT_EQ(shared.labels, alone.labels);
    EXPECT_EQ(shared.noise, alone.noise);
    ASSERT_EQ(shared.planes.size(), alone.planes.size());
    for (std::size_t j = 0; j < alone.planes.size(); ++j) expect_equal(shared.planes[j], alone.planes[j]);
  }
}

TEST(Threads, ChangeNothingInASmallCloud) {
  expect_same_for_any_number_of_threads(room().points);
}

TEST(Threads, ChangeNothingInALargeCloud) {
  expect_same_for_any_number_of_threads(many_points());
}

TEST(Threads, ChangeNothingInTheCanonicalOrder) {
  const std::vector<Vec3> points = many_points();
  Workers one(1);
  Workers three(3);
  const CanonicalCloud alone = canonical_order(points, one);
  const CanonicalCloud shared = canonical_order(points, three);
  EXPECT_EQ(alone.points.count, points.size() - 1000 - 3);
  EXPECT_EQ(shared.points.count, alone.points.count);
  EXPECT_EQ(shared.given, alone.given);
  EXPECT_EQ(shared.first, alone.first);
  for (std::size_t i = 0; i < alone.points.count; ++i) ASSERT_EQ(shared.points.at(i), alone.points.at(i));
}

TEST(Threads, MoreOrFewerThanAllowedAreRefused) {
  AutoOptions options;
  for (const int threads : {-1, 65}) {
    options.threads = threads;
    EXPECT_THROW(PlaneExtractor{options}, std::invalid_argument);
  }
}

}  // namespace
}  // namespace hallway::em
