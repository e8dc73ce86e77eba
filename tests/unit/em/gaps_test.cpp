// SPDX-License-Identifier: MIT
// Planes with gaps in them: what is wide enough separates, and nothing else changes.
#include "em/core/gaps.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "em/core/auto_planes.hpp"

namespace hallway::em {
namespace {

/// Points at every 0.1 on the wall x = 3 from y = from to y = to, 2 high.
void add_wall(double from, double to, std::vector<Vec3>& cloud) {
  const int columns = static_cast<int>((to - from) * 10.0 + 0.5);
  for (int i = 0; i <= columns; ++i) {
    for (int k = 0; k <= 20; ++k) cloud.emplace_back(3.0, from + 0.1 * i, 0.1 * k - 1.0);
  }
}

/// All points as one plane.
Extraction one_plane(const std::vector<Vec3>& cloud) {
  Extraction found;
  Plane& plane = found.planes.emplace_back();
  plane.normal = -Vec3::UnitX();
  plane.offset = -3.0;
  plane.exclusive_share = 0.75;
  for (const Vec3& point : cloud) plane.centroid += point / static_cast<double>(cloud.size());
  for (PointIndex i = 0; i < cloud.size(); ++i) plane.members.push_back(i);
  found.labels.assign(cloud.size(), 0);
  return found;
}

double least_y(const Plane& plane) {
  return std::min_element(plane.hull.begin(), plane.hull.end(),
                          [](const Vec3& a, const Vec3& b) { return a.y() < b.y(); })
      ->y();
}

TEST(Gaps, WiderOnesSeparate) {
  std::vector<Vec3> cloud;
  add_wall(-2.0, 0.0, cloud);
  add_wall(1.0, 4.0, cloud);
  Extraction found = one_plane(cloud);
  split_at_gaps(cloud, 0.6, 12, found);
  ASSERT_EQ(found.planes.size(), 2u);
  EXPECT_GT(found.planes[0].members.size(), found.planes[1].members.size());
  EXPECT_NEAR(least_y(found.planes[0]), 1.0, 1e-9);
  EXPECT_NEAR(least_y(found.planes[1]), -2.0, 1e-9);
  EXPECT_NEAR(found.planes[0].centroid.y(), 2.5, 1e-9);
  for (std::size_t k = 0; k < 2; ++k) {
    const Plane& plane = found.planes[k];
    EXPECT_EQ(plane.id, k);
    EXPECT_EQ(plane.offset, -3.0);
    EXPECT_EQ(plane.exclusive_share, 0.75);
    EXPECT_NEAR(plane.rms, 0.0, 1e-12);
    EXPECT_TRUE(std::is_sorted(plane.members.begin(), plane.members.end()));
    for (const PointIndex member : plane.members) EXPECT_EQ(found.labels[member], k);
  }
}

TEST(Gaps, NarrowOnesDoNot) {
  std::vector<Vec3> cloud;
  add_wall(-2.0, 0.0, cloud);
  add_wall(0.29, 2.0, cloud);
  Extraction found = one_plane(cloud);
  const Extraction before = found;
  split_at_gaps(cloud, 0.6, 12, found);
  ASSERT_EQ(found.planes.size(), 1u);
  EXPECT_EQ(found.planes[0].members, before.planes[0].members);
  EXPECT_EQ(found.planes[0].centroid, before.planes[0].centroid);
  EXPECT_EQ(found.labels, before.labels);
}

TEST(Gaps, SmallPartsAreOfNoPlane) {
  std::vector<Vec3> cloud;
  add_wall(-2.0, 0.0, cloud);
  const auto stray = static_cast<PointIndex>(cloud.size());
  cloud.emplace_back(3.0, 5.0, 0.0);
  Extraction found = one_plane(cloud);
  split_at_gaps(cloud, 0.6, 12, found);
  ASSERT_EQ(found.planes.size(), 1u);
  EXPECT_EQ(found.planes[0].members.size(), cloud.size() - 1);
  EXPECT_EQ(found.labels[stray], kNoPlane);
}

TEST(Gaps, NarrowerThanAnyNumberOfSquaresSeparateAllThatIsApart) {
  std::vector<Vec3> cloud;
  add_wall(-2.0, 0.0, cloud);
  for (const double gap : {1e-3, 1e-12, 1e-300, 5e-324}) {
    Extraction found = one_plane(cloud);
    split_at_gaps(cloud, gap, 1, found);
    EXPECT_EQ(found.planes.size(), cloud.size()) << gap;
    Extraction none = one_plane(cloud);
    split_at_gaps(cloud, gap, 2, none);
    EXPECT_TRUE(none.planes.empty()) << gap;
  }
  const std::vector<Vec3> same(20, Vec3(3.0, 0.0, 0.0));
  Extraction found = one_plane(same);
  split_at_gaps(same, 5e-324, 1, found);
  EXPECT_EQ(found.planes.size(), 1u);
}

TEST(Gaps, AreLookedForWhereTheyAreAskedFor) {
  std::vector<Vec3> cloud;
  add_wall(-4.0, -1.0, cloud);
  add_wall(1.0, 4.0, cloud);
  AutoOptions options;
  options.gap = 0.6;
  EXPECT_EQ(PlaneExtractor(options).extract(cloud).planes.size(), 2u);
}

}  // namespace
}  // namespace hallway::em
