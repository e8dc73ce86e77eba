// SPDX-License-Identifier: MIT
// Maps made by hand: what is exact scores zero, and each fault is seen where it was put.
#include "eval/plane_score.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace hallway::eval {
namespace {

/// A room of 6 x 4 m, 2 m high; walls 0 to 3 are south, east, north, west, each seen from inside.
constexpr std::array<std::array<double, 2>, 4> kRoom{{{0, 0}, {6, 0}, {6, 4}, {0, 4}}};

/// Where the map's frame stands in the world.
Pose T_world_map() {
  return {Quat(Eigen::AngleAxisd(0.4, Vec3::UnitZ())), Vec3(2, 1, 0.8)};
}

/// From inside, the left end of wall k is the room's corner k + 1.
std::array<Vec3, 4> corners_of(std::size_t k) {
  const auto &r = kRoom[k], &l = kRoom[(k + 1) % 4];
  return {Vec3(l[0], l[1], 0), Vec3(r[0], r[1], 0), Vec3(r[0], r[1], 2), Vec3(l[0], l[1], 2)};
}

std::vector<log::TruePlane> true_planes() {
  std::vector<log::TruePlane> walls;
  for (std::size_t k = 0; k < 4; ++k) {
    log::TruePlane& wall = walls.emplace_back();
    wall.id = k;
    for (std::size_t i = 0; i < 4; ++i)
      for (int axis = 0; axis < 3; ++axis)
        wall.corners_m[i][static_cast<std::size_t>(axis)] = corners_of(k)[i][axis];
  }
  return walls;
}

std::array<double, 3> numbers_of(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

/// The plane with these corners in the world, in the map's frame; both ends are certain.
log::PlaneLandmark mapped(log::LandmarkId id, const std::array<Vec3, 4>& corners) {
  const Pose T_map_world = T_world_map().inverse();
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[3] - corners[0]).normalized();
  log::PlaneLandmark plane{
      .id = id, .observations = 9, .normal = numbers_of(T_map_world.q * normal), .outline = {}};
  for (std::size_t i = 0; i < 4; ++i)
    plane.outline.push_back({numbers_of(T_map_world * corners[i]), i % 2 == 1});
  plane.offset_m = (T_map_world.q * normal).dot(T_map_world * corners[0]);
  return plane;
}

/// Planes 10 to 13, which are walls 0 to 3.
std::vector<log::PlaneLandmark> exact_map() {
  std::vector<log::PlaneLandmark> map;
  for (std::size_t k = 0; k < 4; ++k) map.push_back(mapped(10 + k, corners_of(k)));
  return map;
}

/// All walls seen whole by a robot that moves a little in each of 30 frames and knows where it is.
PlaneScore whole_run() {
  PlaneScore score(true_planes());
  for (std::uint32_t frame = 0; frame < 30; ++frame) {
    const Pose T_world_body{Quat(Eigen::AngleAxisd(0.1 * frame, Vec3::UnitZ())),
                            Vec3(2 + 0.05 * frame, 2, 1)};
    std::vector<AssociatedPlane> given;
    std::vector<TruePlanePoint> places;
    for (std::size_t k = 0; k < 4; ++k) {
      given.push_back({k, 10 + k});
      for (const std::size_t i : {0u, 1u}) places.push_back({k, T_world_body.inverse() * corners_of(k)[i]});
    }
    score.add(given, T_world_body, places);
    score.add_pose(frame, T_world_body, T_world_map().inverse() * T_world_body);
  }
  return score;
}

void expect_exact(const std::optional<ErrorSummary>& errors, std::uint64_t count) {
  ASSERT_TRUE(errors);
  EXPECT_EQ(errors->count, count);
  EXPECT_NEAR(errors->max, 0.0, 1e-9);
}

TEST(PlaneScore, AnExactMapHasNoErrors) {
  const PlaneMetrics metrics = whole_run().metrics(exact_map(), exact_map());
  EXPECT_EQ(metrics.observations, 120u);
  EXPECT_EQ(metrics.associations_none + metrics.association_errors, 0u);
  EXPECT_EQ(metrics.walls_true, 4u);
  for (const PlaneMapMetrics& map : {metrics.online, metrics.refined}) {
    EXPECT_EQ(map.mapped, 4u);
    EXPECT_EQ(map.walls_mapped, 4u);
    EXPECT_EQ(map.walls_missing + map.duplicated + map.unmatched, 0u);
    EXPECT_TRUE(map.aligned);
    expect_exact(map.angle_deg, 4);
    expect_exact(map.offset_m, 4);
    expect_exact(map.corner_m, 8);
    EXPECT_NEAR(*map.extent_iou_least, 1.0, 1e-9);
  }
  expect_exact(metrics.position_m, 30);
  expect_exact(metrics.heading_deg, 30);
}

TEST(PlaneScore, AShiftedWallIsOffByItsShift) {
  // Nobody says that its ends are certain, so that the others alone place the map.
  std::vector<log::PlaneLandmark> map = exact_map();
  std::array<Vec3, 4> corners = corners_of(1);
  for (Vec3& corner : corners) corner.x() += 0.1;
  map[1] = mapped(11, corners);
  for (log::OutlineCorner& corner : map[1].outline) corner.edge_certain = false;
  const PlaneMapMetrics refined = whole_run().metrics({}, map).refined;
  ASSERT_TRUE(refined.offset_m && refined.corner_m);
  EXPECT_NEAR(refined.offset_m->max, 0.1, 1e-9);
  EXPECT_NEAR(refined.offset_m->mean, 0.025, 1e-9);
  EXPECT_NEAR(refined.offset_m->rms, 0.05, 1e-9);
  expect_exact(refined.corner_m, 6);
  expect_exact(refined.angle_deg, 4);
}

TEST(PlaneScore, AWallShiftedAlongItselfHasWrongCornersAndAShorterCommonExtent) {
  std::vector<log::PlaneLandmark> map = exact_map();
  std::array<Vec3, 4> corners = corners_of(0);  // from x = 6 to 0
  for (Vec3& corner : corners) corner.x() += 2.0;
  map[0] = mapped(10, corners);
  map[0].outline[3].edge_certain = false;
  const PlaneMapMetrics refined = whole_run().metrics({}, map).refined;
  EXPECT_NEAR(*refined.extent_iou_least, 4.0 / 8.0, 0.1) << "the fit shares the one wrong corner out";
  EXPECT_GT(refined.corner_m->max, 1.0);
  EXPECT_EQ(refined.corner_m->count, 7u);
}

TEST(PlaneScore, ATurnedWallIsOffByItsAngle) {
  std::vector<log::PlaneLandmark> map = exact_map();
  const Quat turn(Eigen::AngleAxisd(2.0 * std::numbers::pi / 180.0, Vec3::UnitZ()));
  std::array<Vec3, 4> corners = corners_of(2);
  const Vec3 middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  for (Vec3& corner : corners) corner = turn * (corner - middle) + middle;
  map[2] = mapped(12, corners);
  for (log::OutlineCorner& corner : map[2].outline) corner.edge_certain = false;
  const PlaneMapMetrics refined = whole_run().metrics({}, map).refined;
  EXPECT_NEAR(refined.angle_deg->max, 2.0, 1e-9);
  expect_exact(refined.offset_m, 4);
}

TEST(PlaneScore, AMissingWallIsCountedAndSoIsADoubledOne) {
  std::vector<log::PlaneLandmark> map = exact_map();
  map.pop_back();
  PlaneScore score = whole_run();
  EXPECT_EQ(score.metrics(map, map).online.walls_missing, 1u);
  EXPECT_EQ(score.metrics(map, map).online.walls_mapped, 3u);
  map = exact_map();
  map.push_back(mapped(14, corners_of(0)));
  map.push_back(mapped(15, corners_of(0)));
  score.add(std::array{AssociatedPlane{0, 14}}, std::nullopt, {});
  const PlaneMapMetrics online = score.metrics(map, {}).online;
  EXPECT_EQ(online.duplicated, 1u);
  EXPECT_EQ(online.unmatched, 1u) << "nothing was ever taken for 15";
  EXPECT_EQ(online.walls_missing, 0u);
}

TEST(PlaneScore, AWallInTwoPartsIsNotDoubled) {
  std::vector<log::PlaneLandmark> map = exact_map();
  map[0] = mapped(10, {Vec3(6, 0, 0), Vec3(3.2, 0, 0), Vec3(3.2, 0, 2), Vec3(6, 0, 2)});
  map[0].outline[1].edge_certain = false;
  map.push_back(mapped(14, {Vec3(2.6, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 2), Vec3(2.6, 0, 2)}));
  map[4].outline[3].edge_certain = false;
  PlaneScore score = whole_run();
  score.add(std::array{AssociatedPlane{0, 14}}, std::nullopt, {});
  const PlaneMapMetrics online = score.metrics(map, {}).online;
  EXPECT_EQ(online.duplicated, 0u);
  EXPECT_EQ(online.parts, 1u);
  EXPECT_EQ(online.walls_mapped, 4u);
  EXPECT_NEAR(*online.extent_iou_least, 5.4 / 6.0, 1e-9);
}

TEST(PlaneScore, TemporaryPlanesAreNotInTheMap) {
  std::vector<log::PlaneLandmark> map = exact_map();
  map[0].status = log::LandmarkStatus::kTemporary;
  const PlaneMapMetrics online = whole_run().metrics(map, {}).online;
  EXPECT_EQ(online.mapped, 3u);
  EXPECT_EQ(online.walls_missing, 1u);
}

TEST(PlaneScore, WallsThatWereHardlySeenAreNotAskedFor) {
  PlaneScore score(true_planes());
  for (std::uint32_t frame = 0; frame < 100; ++frame) {
    std::vector<TruePlanePoint> places{{0, {1, 0, 0}}, {0, {1.2, 0, 0}}};  // 0.2 m of it
    if (frame < PlaneScore::kLeastFrames) places.insert(places.end(), {{1, {6, 1, 0}}, {1, {6, 2, 0}}});
    if (frame + 1 < PlaneScore::kLeastFrames) places.insert(places.end(), {{2, {1, 4, 0}}, {2, {3, 4, 0}}});
    score.add({}, Pose(), places);
  }
  EXPECT_EQ(score.metrics({}, {}).walls_true, 1u);
}

TEST(PlaneScore, OfAWallSeenInPartThatPartIsAskedFor) {
  PlaneScore score(true_planes());
  for (std::size_t k = 0; k < 4; ++k) {
    const std::array<Vec3, 4> corners = corners_of(k);
    const Vec3 right = k == 0 ? Vec3(3, 0, 0) : corners[1];
    score.add(std::array{AssociatedPlane{k, 10 + k}}, Pose(),
              std::array{TruePlanePoint{k, corners[0]}, TruePlanePoint{k, right}});
  }
  std::vector<log::PlaneLandmark> map = exact_map();
  map[0] = mapped(10, {Vec3(6, 0, 0), Vec3(3, 0, 0), Vec3(3, 0, 2), Vec3(6, 0, 2)});
  map[0].outline[1].edge_certain = false;
  EXPECT_NEAR(*score.metrics(map, {}).online.extent_iou_least, 1.0, 1e-9);
}

TEST(PlaneScore, TooFewCornersLeaveTheFirstPose) {
  std::vector<log::PlaneLandmark> map = exact_map();
  for (log::PlaneLandmark& plane : map) {
    for (log::OutlineCorner& corner : plane.outline) corner.edge_certain = false;
  }
  const PlaneMapMetrics online = whole_run().metrics(map, {}).online;
  EXPECT_FALSE(online.aligned);
  EXPECT_FALSE(online.corner_m);
  expect_exact(online.offset_m, 4);
}

TEST(PlaneScore, PoseErrorsAreThoseOnTheMap) {
  PlaneScore score = whole_run();
  const Pose there{Quat::Identity(), Vec3(3, 2, 1)};
  const Pose off{Quat(Eigen::AngleAxisd(-0.1, Vec3::UnitZ())), Vec3(3.3, 2.4, 1)};
  score.add_pose(30, there, T_world_map().inverse() * off);
  const std::vector<log::PoseErrorRow> errors = score.pose_errors(exact_map());
  ASSERT_EQ(errors.size(), 31u);
  EXPECT_EQ(errors.back().iteration, 30u);
  EXPECT_NEAR(errors.back().position_m, 0.5, 1e-9);
  EXPECT_NEAR(errors.back().heading_deg, -0.1 * 180.0 / std::numbers::pi, 1e-9);
}

TEST(PlaneScore, NothingOfNothing) {
  const PlaneMetrics metrics = PlaneScore({}).metrics({}, {});
  EXPECT_EQ(metrics.walls_true + metrics.online.mapped, 0u);
  EXPECT_FALSE(metrics.online.offset_m || metrics.position_m || metrics.online.extent_iou_mean);
}

}  // namespace
}  // namespace hallway::eval
