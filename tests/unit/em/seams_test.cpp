// SPDX-License-Identifier: MIT
// Points that two planes share where they meet.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "em/core/auto_planes.hpp"
#include "unit/em/auto_scene.hpp"

namespace hallway::em {
namespace {

using namespace hallway::em::test;  // NOLINT

constexpr double kSigma = 0.02;

/// A floor and a wall that stands on it, x from -2 to 2, and a sheet that touches neither.
LabelledPoints corner() {
  LabelledPoints cloud;
  add(cloud, {{0.0, 1.5, 1.0}, Vec3::UnitX(), Vec3::UnitY(), 2.0, 1.5, 3000, kSigma}, 0);
  add(cloud, {{0.0, 0.0, 2.5}, Vec3::UnitX(), Vec3::UnitZ(), 2.0, 1.5, 2500, kSigma}, 1);
  add(cloud, {{0.0, 6.0, 4.0}, Vec3::UnitX(), Vec3::UnitZ(), 1.0, 1.0, 1000, kSigma}, 2);
  return cloud;
}

Extraction extract(const std::vector<Vec3>& points, int seams) {
  AutoOptions options;
  options.seams = seams;
  return PlaneExtractor(options).extract(points);
}

std::vector<PointIndex> in_both(const Plane& left, const Plane& right) {
  std::vector<PointIndex> both;
  std::set_intersection(left.members.begin(), left.members.end(), right.members.begin(), right.members.end(),
                        std::back_inserter(both));
  return both;
}

double distance(const Plane& plane, const Vec3& p) {
  return std::abs(plane.normal.dot(p) - plane.offset);
}

TEST(Seams, ArePointsOfOnePlaneUnlessAskedFor) {
  const Extraction found = extract(corner().points, 0);
  ASSERT_EQ(found.planes.size(), 3u);
  EXPECT_TRUE(in_both(found.planes[0], found.planes[1]).empty());
}

TEST(Seams, ArePointsOfBothPlanesWithinTheirNoise) {
  const LabelledPoints cloud = corner();
  const Extraction found = extract(cloud.points, 1);
  ASSERT_EQ(found.planes.size(), 3u);
  const std::vector<PointIndex> both = in_both(found.planes[0], found.planes[1]);
  // The floor has 500 points a square metre, the wall 417: within two sigmas of the other plane there are 4 m times 4 cm
  // of each, thus about 80 and 67 points, of which half are to be expected where the other one's noise reaches.
  EXPECT_GE(both.size(), 40u);
  EXPECT_LE(both.size(), 150u);
  for (const PointIndex i : both) {
    EXPECT_LE(distance(found.planes[0], cloud.points[i]), 2.5 * kSigma);
    EXPECT_LE(distance(found.planes[1], cloud.points[i]), 2.5 * kSigma);
  }
  EXPECT_TRUE(in_both(found.planes[0], found.planes[2]).empty());
  EXPECT_TRUE(in_both(found.planes[1], found.planes[2]).empty());
}

TEST(Seams, AddMembersAndChangeNeitherPlanesNorLabels) {
  const LabelledPoints cloud = corner();
  const Extraction apart = extract(cloud.points, 0);
  const Extraction shared = extract(cloud.points, 1);
  EXPECT_EQ(shared.labels, apart.labels);
  ASSERT_EQ(shared.planes.size(), apart.planes.size());
  for (std::size_t j = 0; j < apart.planes.size(); ++j) {
    const Plane& with = shared.planes[j];
    const Plane& without = apart.planes[j];
    EXPECT_EQ(with.normal, without.normal);
    EXPECT_EQ(with.exclusive_share, without.exclusive_share);
    EXPECT_TRUE(std::is_sorted(with.members.begin(), with.members.end()));
    EXPECT_EQ(std::adjacent_find(with.members.begin(), with.members.end()), with.members.end());
    EXPECT_TRUE(std::includes(with.members.begin(), with.members.end(), without.members.begin(),
                              without.members.end()));
  }
  EXPECT_EQ(shared.planes[2].members, apart.planes[2].members);
}

TEST(Seams, AreNotWhereOneOfTwoNearSheetsExplainsThePoint) {
  LabelledPoints cloud;
  add(cloud, {{0.0, 0.0, 1.0}, Vec3::UnitX(), Vec3::UnitY(), 2.0, 2.0, 2000, kSigma}, 0);
  add(cloud, {{0.0, 0.0, 1.0 + 6 * kSigma}, Vec3::UnitX(), Vec3::UnitY(), 2.0, 2.0, 1500, kSigma}, 1);
  const Extraction found = extract(cloud.points, 1);
  ASSERT_EQ(found.planes.size(), 2u);
  EXPECT_TRUE(in_both(found.planes[0], found.planes[1]).empty());
}

}  // namespace
}  // namespace hallway::em
