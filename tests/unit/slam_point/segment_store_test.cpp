// SPDX-License-Identifier: MIT
#include "slam_point/core/submaps/segment_store.hpp"

#include <gtest/gtest.h>

#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"

namespace hallway::slam_point {
namespace {

constexpr FitRules kRules{false, 0.25};
using Sightings = std::vector<SegmentStore::Sighting>;

std::vector<Vec3> some_points(Index count, std::uint64_t seed) {
  scenes::Random random(seed);
  std::vector<Vec3> points;
  for (Index i = 0; i < count; ++i)
    points.push_back(Vec3(random.uniform(5, 20), random.uniform(-9, 9), random.uniform(-4, 4)));
  return points;
}

/// Landmarks first … first + count - 1 as a sensor at T sees them.
Sightings sighted(const std::vector<Vec3>& points, const Pose& T, Index first, Index count,
                  double noise_m = 0.0, std::uint64_t seed = 1) {
  scenes::Random random(seed);
  Sightings sightings;
  for (Index l = first; l < first + count; ++l)
    sightings.push_back(
        {l, T.inverse() * points[l] + noise_m * Vec3(random.normal(), random.normal(), random.normal())});
  return sightings;
}

TEST(SegmentStore, FramesThatSeeTheSameAreOneSegment) {
  const std::vector<Vec3> points = some_points(20, 1);
  SegmentStore store;
  for (int f = 0; f < 10; ++f) {
    const Pose T = scenes::heading(Vec3(0.1 * f, 0, 0), 0.02 * f);
    // Told a little wrong: within the segment the frame is aligned anew.
    const Pose told = f == 0 ? T : T * Pose{rotation_exp(Vec3(0.01, -0.02, 0.01)), Vec3(0.05, 0.02, -0.03)};
    store.add_frame(0, told, kRules, sighted(points, T, 0, 20));
  }
  ASSERT_EQ(store.segments().size(), 1u);
  const Segment& segment = store.segments()[0];
  EXPECT_EQ(segment.frames, 10u);
  ASSERT_EQ(segment.members.size(), 20u);
  for (const SegmentMember& member : segment.members) {
    EXPECT_EQ(member.count, 10u);
    EXPECT_LT((member.mean - points[member.landmark]).norm(), 1e-9);
  }
  EXPECT_LT(store.scatter_m2(), 1e-15);
  EXPECT_EQ(store.freedom(), 9.0 * (3 * 20 - 6));
}

TEST(SegmentStore, AnotherViewStartsAnotherSegmentAndTheFirstIsTakenUpAgain) {
  const std::vector<Vec3> points = some_points(40, 2);
  SegmentStore store;
  store.add_frame(0, Pose{}, kRules, sighted(points, {}, 0, 20));
  store.add_frame(0, Pose{}, kRules, sighted(points, {}, 1, 20));  // 19 of 21 are shared
  EXPECT_EQ(store.segments().size(), 1u);
  EXPECT_EQ(store.segments()[0].members.size(), 21u);
  store.add_frame(0, Pose{}, kRules, sighted(points, {}, 10, 20));
  EXPECT_EQ(store.segments().size(), 2u);
  store.add_frame(0, Pose{}, kRules, sighted(points, {}, 0, 20));
  ASSERT_EQ(store.segments().size(), 2u);
  EXPECT_EQ(store.segments()[0].frames, 3u);
  store.add_frame(1, Pose{}, kRules, sighted(points, {}, 0, 20));
  ASSERT_EQ(store.segments().size(), 3u) << "another submap's";
  EXPECT_EQ(store.segments()[2].submap, 1u);
}

TEST(SegmentStore, MemoryIsBoundedOnKnownGround) {
  const std::vector<Vec3> points = some_points(120, 3);
  scenes::Random random(7);
  SegmentStore store;
  for (int f = 0; f < 2000; ++f) {
    const auto first = static_cast<Index>(random.uniform(0, 100));
    store.add_frame(0, Pose{}, kRules,
                    sighted(points, {}, first, 5 + static_cast<Index>(random.uniform(0, 15))));
  }
  EXPECT_LE(store.segments().size(), 64u);
  EXPECT_EQ(store.frames(), 2000u);
}

TEST(SegmentStore, TheNoiseIsEstimatedFromWhatIsLeft) {
  const std::vector<Vec3> points = some_points(30, 4);
  for (const bool planar : {false, true}) {
    std::vector<Vec3> flat = points;
    SegmentStore store;
    EXPECT_EQ(store.noise2_m2(), 0.0);
    for (int f = 0; f < 300; ++f) {
      for (Vec3& p : flat) p.z() = planar ? 0.0 : p.z();
      Sightings sightings =
          sighted(flat, {}, static_cast<Index>(f / 20), 15, 0.05, 100 + static_cast<std::uint64_t>(f));
      for (auto& sighting : sightings) sighting.point.z() *= planar ? 0.0 : 1.0;
      store.add_frame(0, Pose{}, {planar, kRules.min_spread_m2}, sightings);
    }
    // About 1e4 degrees of freedom: two standard deviations are 3 %.
    EXPECT_NEAR(store.noise2_m2(), 0.05 * 0.05, 0.03 * 0.05 * 0.05) << planar;
  }
}

}  // namespace
}  // namespace hallway::slam_point
