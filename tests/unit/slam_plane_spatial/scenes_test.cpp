// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "unit/slam_plane_spatial/scene.hpp"
#include "unit/slam_plane_spatial/yardstick.hpp"

namespace hallway::slam_plane::spatial::test {
namespace {

std::string told(const Outcome& o) {
  std::ostringstream out;
  out << "position " << o.position_rmse_m << " plane " << o.plane_rmse_m << " edge " << o.edge_rmse_m
      << " lost " << o.lost << " missing " << o.missing << " again " << o.duplicated;
  return out.str();
}

void expect_exact(const Outcome& outcome) {
  EXPECT_EQ(outcome.lost, 0);
  EXPECT_EQ(outcome.missing, 0);
  EXPECT_EQ(outcome.wrong, 0);
  EXPECT_EQ(outcome.counters.dynamic, 0u);
  EXPECT_EQ(outcome.false_edges, 0);
  EXPECT_LT(outcome.worst_position_m, 0.001);
  EXPECT_LT(outcome.worst_turn_rad, 0.001);
  EXPECT_LT(outcome.worst_plane_m, 0.001);
  EXPECT_LT(outcome.worst_edge_m, 0.001);
}

TEST(SpatialScenes, WithoutNoiseARoomIsMappedExactly) {
  const Scene scene = furnished_room(320);  // once round
  const Outcome outcome = run(scene, see(scene, NoiseOf{}, 1), Options{});
  expect_exact(outcome);
  EXPECT_EQ(outcome.duplicated, 0);
  EXPECT_GT(outcome.certain_edges, 40);
}

TEST(SpatialScenes, WithoutNoiseTwoRoomsAreMappedExactly) {
  const Scene scene = two_rooms();
  const Outcome outcome = run(scene, see(scene, NoiseOf{}, 1), Options{});
  expect_exact(outcome);
  EXPECT_LE(outcome.duplicated, 1) << "a wall of which two parts are never seen together";
  EXPECT_GT(outcome.certain_edges, 60);
}

TEST(SpatialScenes, WithoutNoiseEdgesAtObtuseCornersAreMappedExactly) {
  const Scene scene = ramp_room(320);
  const Outcome outcome = run(scene, see(scene, NoiseOf{}, 1), Options{});
  expect_exact(outcome);
  EXPECT_EQ(outcome.duplicated, 0);
}

TEST(SpatialScenes, WhereTheMapBeginsDoesNotMatter) {
  const Scene whole = furnished_room(320);
  Scene later = whole;
  later.path.erase(later.path.begin(), later.path.begin() + 60);
  expect_exact(run(later, see(later, NoiseOf{}, 1), Options{}));
}

TEST(SpatialScenes, WithNoiseTheMapIsNearlyAsGoodAsTheDataAllow) {
  const Scene scene = furnished_room(120);
  for (const std::uint64_t seed : {1u, 2u}) {
    const auto frames = see(scene, kNoise, seed);
    const Outcome best = yardstick(scene, frames, Options{});
    const Outcome outcome = run(scene, frames, Options{});
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", best " << told(best) << ", is "
                                    << told(outcome));
    EXPECT_EQ(outcome.lost, 0);
    EXPECT_EQ(outcome.missing, 0);
    EXPECT_EQ(outcome.false_edges, 0);
    EXPECT_LT(outcome.plane_rmse_m, 1.5 * best.plane_rmse_m);
    EXPECT_LT(outcome.edge_rmse_m, 1.5 * best.edge_rmse_m);
    EXPECT_LT(outcome.position_rmse_m, 2.0 * best.position_rmse_m) << "as answered, while the map is young";
  }
}

TEST(SpatialScenes, WithNoiseTwoRoomsAreMappedThereAndBack) {
  const Scene scene = two_rooms();
  const Outcome outcome = run(scene, see(scene, kNoise, 1), Options{});
  SCOPED_TRACE(told(outcome));
  EXPECT_EQ(outcome.lost, 0);
  EXPECT_EQ(outcome.missing, 0);
  EXPECT_EQ(outcome.false_edges, 0);
  EXPECT_LE(outcome.duplicated, 1);
  EXPECT_EQ(outcome.counters.dynamic, 0u) << "nothing moves";
  EXPECT_LT(outcome.position_rmse_m, 0.02);
  EXPECT_LT(outcome.plane_rmse_m, 0.01);
}

}  // namespace
}  // namespace hallway::slam_plane::spatial::test
