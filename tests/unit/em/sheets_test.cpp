// SPDX-License-Identifier: MIT
#include "em/core/sheets.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "em/core/auto_planes.hpp"
#include "unit/em/auto_scene.hpp"

namespace hallway::em {
namespace {

using namespace hallway::em::test;  // NOLINT

/// Heights of two sheets of noise 1, so far apart.
std::vector<double> heights(std::size_t low, std::size_t high, double gap) {
  const Random random(1, stream_id("test.em.sheets"));
  std::vector<double> all;
  for (std::size_t i = 0; i < low + high; ++i)
    all.push_back(random.normal(static_cast<std::uint32_t>(low), i) + (i < low ? 0.0 : gap));
  return all;
}

TEST(Sheets, TwoAreTwoAndOneIsOne) {
  const std::optional<TwoSheets> pair = two_sheets(heights(120, 80, 6.0), 12);
  ASSERT_TRUE(pair);
  EXPECT_NEAR(pair->low, 0.0, 0.3);
  EXPECT_NEAR(pair->high, 6.0, 0.4);
  EXPECT_NEAR(pair->noise, 1.0, 0.15);
  EXPECT_FALSE(two_sheets(heights(200, 0, 0.0), 12));
  EXPECT_FALSE(two_sheets(heights(100, 100, 2.0), 12));
  std::vector<double> even;
  for (int i = 0; i < 200; ++i) even.push_back(i);
  EXPECT_FALSE(two_sheets(even, 12));
}

TEST(Sheets, FewPointsAreNoSheet) {
  EXPECT_TRUE(two_sheets(heights(30, 30, 8.0), 12));
  EXPECT_FALSE(two_sheets(heights(30, 4, 8.0), 12));
  EXPECT_FALSE(two_sheets(heights(300, 30, 8.0), 12)) << "less than a fifth";
  EXPECT_FALSE(two_sheets({}, 12));
  EXPECT_FALSE(two_sheets(std::vector<double>(50, 1.0), 12));
}

TEST(Sheets, APlaneWhoseHeightsAreASinesIsOnePlane) {
  // Its variance within the halves is that of two sheets four standard deviations apart.
  std::vector<Vec3> points;
  for (int i = 0; i < 30; ++i) {
    for (int k = 0; k < 30; ++k)
      points.emplace_back(0.1 * i, 0.1 * k, 0.004 * std::sin(1.0 + 12.9898 * i + 78.233 * k));
  }
  const Extraction found = PlaneExtractor().extract(points);
  ASSERT_EQ(found.planes.size(), 1u);
  EXPECT_EQ(found.planes[0].members.size(), points.size());
}

TEST(Sheets, ParallelPlanesNearerThanTheirPointsAreFound) {
  LabelledPoints cloud;
  add(cloud, {{5.0, 5.0, 5.0}, Vec3::UnitX(), Vec3::UnitY(), 1.8, 1.1, 180, 0.008}, 0);
  add(cloud, {{5.0, 5.0, 5.05}, Vec3::UnitX(), Vec3::UnitY(), 1.8, 1.1, 140, 0.008}, 1);
  const Extraction found = PlaneExtractor().extract(cloud.points);
  ASSERT_EQ(found.planes.size(), 2u);
  EXPECT_GE(best_overlap(cloud, found, 0), 0.95);
  EXPECT_GE(best_overlap(cloud, found, 1), 0.95);
}

}  // namespace
}  // namespace hallway::em
