// SPDX-License-Identifier: MIT
#include "eval/refitted_path.hpp"

#include <gtest/gtest.h>

#include "random_motion.hpp"

namespace hallway::eval {
namespace {

using log::kNoLandmark;
using log::LandmarkStatus;
using log::MapLandmark;
using Ids = std::vector<log::LandmarkId>;
using Points = std::vector<Vec3>;

/// Four landmarks that span space.
const std::vector<MapLandmark> kMap = {
    {1, {5, 0, 0}, 9}, {2, {0, 6, 0}, 9}, {3, {0, 0, 7}, 9}, {4, {3, 3, 3}, 9}};
const Ids kAll = {1, 2, 3, 4};

/// What a body at T_map_body sees of them.
Points seen_from(const Pose& T_map_body) {
  Points points;
  for (const MapLandmark& landmark : kMap)
    points.push_back(T_map_body.inverse() * Vec3(landmark.position_m.data()));
  return points;
}

TEST(RefittedPath, WithoutNoiseEveryFrameStandsWhereItWas) {
  const Pose T_world_map = random_motion(5);
  RefittedPath path;
  for (std::uint32_t i = 0; i < 10; ++i) {
    const Pose T_map_body = random_motion(6, i);
    path.add(T_world_map * T_map_body.t, seen_from(T_map_body), kAll);
  }
  const auto error = path.error(kMap);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->frames, 10u);
  EXPECT_NEAR(*error->aligned_m, 0.0, 1e-12);
}

TEST(RefittedPath, AnErrorOfTheMapMovesTheFramesThatSeeIt) {
  RefittedPath path;
  for (std::uint32_t i = 0; i < 10; ++i) {
    const Pose T_map_body = random_motion(6, i);
    // Half of the frames do not see the landmark that will be wrong.
    path.add(T_map_body.t, seen_from(T_map_body), i % 2 == 0 ? kAll : Ids{kNoLandmark, 2, 3, 4});
  }
  std::vector<MapLandmark> bent = kMap;
  bent[0].position_m[1] += 0.5;
  EXPECT_GT(*path.error(bent)->aligned_m, 0.01);
}

TEST(RefittedPath, FramesThatDetermineNoPoseAreLeftOut) {
  RefittedPath path;
  const Points points = seen_from({});
  path.add(Vec3::Zero(), points, Ids{1, 2, kNoLandmark, kNoLandmark});
  path.add(Vec3::Zero(), points, Ids{1, 2, 77, 78});  // the map knows neither of the last two
  path.add(Vec3::Zero(), Points{{1, 0, 0}, {2, 0, 0}, {3, 1e-3, 0}}, Ids{1, 2, 3});
  path.add(Vec3::Zero(), {}, Ids{});
  const auto error = path.error(kMap);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->frames, 0u);
  EXPECT_FALSE(error->aligned_m);
}

TEST(RefittedPath, OnlyMappedLandmarksCount) {
  RefittedPath path;
  path.add(Vec3::Zero(), seen_from({}), kAll);
  std::vector<MapLandmark> map = kMap;
  map[0].status = LandmarkStatus::kTemporary;
  EXPECT_EQ(path.error(map)->frames, 1u);
  map[1].status = LandmarkStatus::kDynamic;
  EXPECT_EQ(path.error(map)->frames, 0u);
}

}  // namespace
}  // namespace hallway::eval
