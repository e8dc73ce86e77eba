// SPDX-License-Identifier: MIT
#include "eval/evaluator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "eval/metrics_json.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway::eval {
namespace {

using log::kNoLandmark;
using log::LandmarkStatus;
using log::MapLandmark;
using Ids = std::vector<log::LandmarkId>;
using Map = std::vector<MapLandmark>;

// Map landmarks are numbered from 100, true ones from 1.

Pose at(double x, double y, double z) {
  return {Quat::Identity(), {x, y, z}};
}

/// Three true landmarks at the corners of a triangle.
Truth triangle() {
  return {true, std::vector<log::Landmark>{{1, {0, 0, 0}}, {2, {10, 0, 0}}, {3, {0, 10, 0}}}};
}

/// The vectors must outlive the iteration.
Iteration seen(const Ids& associations, const Ids& identities) {
  Iteration iteration;
  iteration.associations = associations;
  iteration.identities = identities;
  return iteration;
}

const Ids kAllTrue = {1, 2, 3};
const Ids kAllMapped = {100, 101, 102};
const Map kExactMap = {{100, {0, 0, 0}}, {101, {10, 0, 0}}, {102, {0, 10, 0}}};

TEST(Evaluator, WithoutAnythingCountsZeroAndKnowsNothing) {
  const Metrics metrics = Evaluator(Truth{}).metrics({}, std::nullopt);
  EXPECT_EQ(metrics.iterations, 0u);
  EXPECT_EQ(metrics.observations, 0u);
  EXPECT_EQ(metrics.lost_iterations, 0u);
  EXPECT_EQ(metrics.landmarks_mapped, 0u);
  EXPECT_FALSE(metrics.landmarks_true);
  EXPECT_FALSE(metrics.association_errors);
  EXPECT_FALSE(metrics.landmarks_duplicated);
  EXPECT_FALSE(metrics.landmark_rmse_m.aligned);
  EXPECT_FALSE(metrics.position_rmse_m.first_pose);
  EXPECT_FALSE(metrics.iteration_ms);
}

TEST(Evaluator, WithoutIdentitiesAssociationsAreNotScored) {
  Evaluator evaluator(Truth{false, triangle().landmarks});
  evaluator.add(seen({100, kNoLandmark}, {}));
  const Metrics metrics = evaluator.metrics(kExactMap, kExactMap);
  EXPECT_EQ(metrics.observations, 2u);
  EXPECT_EQ(metrics.associations_none, 1u);
  EXPECT_EQ(metrics.landmarks_mapped, 3u);
  EXPECT_FALSE(metrics.landmarks_true);
  EXPECT_FALSE(metrics.landmarks_duplicated);
  EXPECT_FALSE(metrics.landmarks_missed);
  EXPECT_FALSE(metrics.landmarks_unmatched);
  EXPECT_FALSE(metrics.association_errors);
  EXPECT_FALSE(metrics.landmark_rmse_m.aligned);
  EXPECT_FALSE(metrics.landmark_rmse_final_aligned_m);
}

TEST(Evaluator, WithoutTrueLandmarksTheirErrorsAreUnknown) {
  Evaluator evaluator(Truth{true, std::nullopt});
  evaluator.add(seen(kAllMapped, kAllTrue));
  const Metrics metrics = evaluator.metrics(kExactMap, kExactMap);
  EXPECT_EQ(metrics.landmarks_true, 3u);
  EXPECT_EQ(metrics.association_errors, 0u);
  EXPECT_EQ(metrics.landmarks_duplicated, 0u);
  EXPECT_EQ(metrics.landmark_pairs, 0u);
  EXPECT_FALSE(metrics.landmark_rmse_m.aligned);
  EXPECT_FALSE(metrics.landmark_rmse_final_aligned_m);
}

TEST(Evaluator, CountsLandmarksByStatusAndOwner) {
  Evaluator evaluator(triangle());
  evaluator.add(seen({100, 101, 102, 103, kNoLandmark}, {1, 1, 2, 2, 3}));
  const Map map = {{100, {0, 0, 0}},
                   {101, {0, 0, 0}},  // true landmark 1 once more
                   {102, {10, 0, 0}},
                   {103, {10, 0, 0}, 1, LandmarkStatus::kTemporary},  // does not count
                   {104, {5, 5, 5}, 1, LandmarkStatus::kDynamic},     // does not count
                   {105, {5, 5, 5}}};                                 // never given an observation
  const Metrics metrics = evaluator.metrics(map, std::nullopt);
  EXPECT_EQ(metrics.landmarks_true, 3u);
  EXPECT_EQ(metrics.landmarks_mapped, 4u);
  EXPECT_EQ(metrics.landmarks_duplicated, 1u);
  EXPECT_EQ(metrics.landmarks_missed, 1u);
  EXPECT_EQ(metrics.landmarks_unmatched, 1u);
  EXPECT_EQ(metrics.landmark_pairs, 3u);
  EXPECT_EQ(metrics.associations_none, 1u);
}

TEST(Evaluator, CountsTheSurplusOfDuplicates) {
  Evaluator evaluator(triangle());
  evaluator.add(seen({100, 101, 102, 103, 104}, {1, 1, 1, 2, 2}));
  const Map map = {{100, {}}, {101, {}}, {102, {}}, {103, {}}, {104, {}}};
  EXPECT_EQ(evaluator.metrics(map, std::nullopt).landmarks_duplicated, 3u);  // two of 1 and one of 2
}

TEST(Evaluator, LandmarksThatWereMergedAwayAreNoDuplicates) {
  Evaluator evaluator(triangle());
  evaluator.add(seen({100, 101, 102, 103}, {1, 2, 3, 3}));
  const Metrics metrics = evaluator.metrics(kExactMap, std::nullopt);
  EXPECT_EQ(metrics.landmarks_duplicated, 0u);
  EXPECT_EQ(metrics.association_errors, 0u);
}

TEST(Evaluator, LandmarkErrorsAreTakenInBothFrames) {
  Evaluator evaluator(triangle());
  Iteration iteration = seen(kAllMapped, kAllTrue);
  iteration.T_world_body = at(1, 0, 0);
  iteration.T_map_body = at(0, 0, 0);  // the map's origin stands at (1, 0, 0)
  evaluator.add(iteration);
  Map map = kExactMap;
  for (MapLandmark& landmark : map) landmark.position_m[2] += 2.0;
  const Metrics metrics = evaluator.metrics(map, std::nullopt);
  EXPECT_EQ(metrics.landmark_pairs, 3u);
  EXPECT_NEAR(*metrics.landmark_rmse_m.first_pose, std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(*metrics.landmark_rmse_m.aligned, 0.0, 1e-9);
  EXPECT_FALSE(metrics.landmark_rmse_final_aligned_m);
}

TEST(Evaluator, DuplicatesAllCountInTheLandmarkError) {
  Evaluator evaluator(triangle());
  const Ids associations = {100, 101, 102, 103};
  const Ids identities = {1, 2, 3, 3};
  Iteration iteration = seen(associations, identities);
  iteration.T_world_body = at(0, 0, 0);
  iteration.T_map_body = at(0, 0, 0);
  evaluator.add(iteration);
  Map map = kExactMap;
  map.push_back({103, {0, 10, 6}});
  const Metrics metrics = evaluator.metrics(map, std::nullopt);
  EXPECT_EQ(metrics.landmark_pairs, 4u);
  EXPECT_NEAR(*metrics.landmark_rmse_m.first_pose, 3.0, 1e-12);
}

TEST(Evaluator, FewerThanThreePairsAreNotAligned) {
  Evaluator evaluator(triangle());
  Iteration iteration = seen(kAllMapped, kAllTrue);
  iteration.T_world_body = at(0, 0, 0);
  iteration.T_map_body = at(0, 0, 0);
  evaluator.add(iteration);
  const Map map = {kExactMap[0], kExactMap[1]};
  const Metrics metrics = evaluator.metrics(map, map);
  EXPECT_EQ(metrics.landmark_pairs, 2u);
  EXPECT_TRUE(metrics.landmark_rmse_m.first_pose);
  EXPECT_FALSE(metrics.landmark_rmse_m.aligned);
  EXPECT_FALSE(metrics.landmark_rmse_final_aligned_m);
}

TEST(Evaluator, WithoutAPosePairTheFirstPoseFrameIsUnknown) {
  Evaluator evaluator(triangle());
  Iteration iteration = seen(kAllMapped, kAllTrue);
  iteration.T_world_body = at(0, 0, 0);
  evaluator.add(iteration);
  const Metrics metrics = evaluator.metrics(kExactMap, std::nullopt);
  EXPECT_FALSE(metrics.landmark_rmse_m.first_pose);
  EXPECT_NEAR(*metrics.landmark_rmse_m.aligned, 0.0, 1e-9);
}

TEST(Evaluator, ObservedLandmarksOfUnknownPlaceAreLeftOutOfTheError) {
  Evaluator evaluator(triangle());
  evaluator.add(seen({100, 101, 102, 103}, {1, 2, 3, 77}));
  Map map = kExactMap;
  map.push_back({103, {500, 0, 0}});
  const Metrics metrics = evaluator.metrics(map, std::nullopt);
  EXPECT_EQ(metrics.landmarks_true, 4u);
  EXPECT_EQ(metrics.landmark_pairs, 3u);
  EXPECT_NEAR(*metrics.landmark_rmse_m.aligned, 0.0, 1e-9);
}

TEST(Evaluator, TheFinalMapIsScoredByItself) {
  Evaluator evaluator(triangle());
  evaluator.add(seen(kAllMapped, kAllTrue));
  Map online = kExactMap;
  online[2].position_m = {0, 13, 0};
  const Metrics metrics = evaluator.metrics(online, kExactMap);
  EXPECT_GT(*metrics.landmark_rmse_m.aligned, 0.5);
  EXPECT_NEAR(*metrics.landmark_rmse_final_aligned_m, 0.0, 1e-9);
}

TEST(Evaluator, AnEmptyFinalMapIsNotAGoodOne) {
  Evaluator evaluator(triangle());
  evaluator.add(seen(kAllMapped, kAllTrue));
  EXPECT_FALSE(evaluator.metrics(kExactMap, Map{}).landmark_rmse_final_aligned_m);
}

TEST(Evaluator, LostIterationsAreCountedAndLeftOutOfThePairs) {
  Evaluator evaluator(Truth{});
  Iteration lost;
  lost.T_world_body = at(100, 0, 0);
  evaluator.add(lost);
  for (int i = 0; i < 3; ++i) {
    Iteration iteration;
    iteration.T_world_body = at(i, i * i, 0);
    iteration.T_map_body = at(i, i * i, 0);
    evaluator.add(iteration);
  }
  evaluator.add(lost);
  const Metrics metrics = evaluator.metrics({}, std::nullopt);
  EXPECT_EQ(metrics.iterations, 5u);
  EXPECT_EQ(metrics.lost_iterations, 2u);
  EXPECT_EQ(metrics.position_pairs, 3u);
  EXPECT_NEAR(*metrics.position_rmse_m.first_pose, 0.0, 1e-12);
  EXPECT_NEAR(*metrics.position_final_m, 0.0, 1e-12);
}

TEST(Evaluator, AnEstimateWithoutTruthIsNotLost) {
  Evaluator evaluator(Truth{});
  Iteration iteration;
  iteration.T_map_body = at(0, 0, 0);
  evaluator.add(iteration);
  const Metrics metrics = evaluator.metrics({}, std::nullopt);
  EXPECT_EQ(metrics.lost_iterations, 0u);
  EXPECT_EQ(metrics.position_pairs, 0u);
  EXPECT_FALSE(metrics.position_rmse_m.first_pose);
}

TEST(Evaluator, APluginThatHasNoPosesToGiveIsNotLost) {
  for (const bool gives_poses : {true, false}) {
    Truth truth;
    truth.gives_poses = gives_poses;
    Evaluator evaluator(truth);
    for (int i = 0; i < 4; ++i) {
      Iteration iteration;
      iteration.T_world_body = at(i, i * i, 0);
      evaluator.add(iteration);
    }
    const Metrics metrics = evaluator.metrics({}, std::nullopt);
    EXPECT_EQ(metrics.iterations, 4u);
    EXPECT_EQ(metrics.verdict == PathVerdict::kLost, gives_poses);
    EXPECT_EQ(metrics.verdict.has_value(), gives_poses);
    EXPECT_EQ(metrics.lost_iterations, gives_poses ? std::optional<std::uint64_t>(4) : std::nullopt);
    EXPECT_EQ(metrics.pose_coverage(), gives_poses ? std::optional<double>(0.0) : std::nullopt);
  }
}

TEST(Evaluator, TimesAreSummarizedEach) {
  Evaluator evaluator(Truth{});
  for (const double wall_ms : {1.0, 2.0, 6.0}) {
    Iteration iteration;
    iteration.wall_ms = wall_ms;
    iteration.cpu_ms = wall_ms / 2;
    evaluator.add(iteration);
  }
  const Metrics metrics = evaluator.metrics({}, std::nullopt);
  EXPECT_EQ(metrics.iteration_ms->mean, 3.0);
  EXPECT_EQ(metrics.iteration_ms->p50, 2.0);
  EXPECT_EQ(metrics.iteration_cpu_ms->max, 3.0);
}

TEST(Evaluator, RefusesIdentitiesThatDoNotMatchTheObservations) {
  Evaluator evaluator(triangle());
  const auto error = test::error_of([&] { evaluator.add(seen({100}, {})); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kInternal);
}

/// A long run in several parts, with covariances and points, given to an evaluator.
Metrics metrics_of_long_run(Evaluator evaluator) {
  Map map = kExactMap;
  for (MapLandmark& landmark : map) landmark.observations = 100;
  constexpr std::uint32_t kFrames = 5000;  // of which no list fits into one window
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    const Pose truth{from_yaw_pitch_roll(0.01 * i, 0, 0), {0.001 * i, std::sin(0.01 * i), 0.2}};
    const Pose error{from_yaw_pitch_roll(1e-3 * (i % 7), 0, 0), {1e-3 * (i % 5), 1e-3 * (i % 3), 0}};
    const std::vector<Vec3> points = {truth.inverse() * Vec3(0, 0, 0), truth.inverse() * Vec3(10, 0, 0),
                                      truth.inverse() * Vec3(0, 10, 0)};
    Iteration iteration;
    iteration.T_world_body = truth;
    if (i % 11 != 0) iteration.T_map_body = truth * error;
    if (i % 3 != 0) iteration.pose_covariance = 1e-6 * (1 + i % 4) * Eigen::Matrix<double, 6, 6>::Identity();
    iteration.map_epoch = i / 1000;
    iteration.t_s = 0.1 * i;
    iteration.associations = kAllMapped;
    iteration.identities = kAllTrue;
    iteration.points = points;
    iteration.wall_ms = 1.0 + i % 13;
    iteration.cpu_ms = 0.5 + i % 17;
    evaluator.add(iteration);
  }
  const std::vector<JoinedEpoch> joined = {{1, 0}, {3, 0}};
  evaluator.finish(joined);
  return evaluator.metrics(map, map, joined);
}

TEST(Evaluator, AFolderChangesNoBit) {
  const test::TempFolder folder;
  const Metrics in_memory = metrics_of_long_run(Evaluator(triangle()));
  const Metrics in_folder = metrics_of_long_run(Evaluator(triangle(), folder.path()));
  EXPECT_EQ(to_json(in_folder).dump(), to_json(in_memory).dump());
  EXPECT_EQ(in_folder.parts.count, 3u);
  EXPECT_EQ(in_folder.position_refitted_pairs, 5000u);
  EXPECT_GT(in_folder.pose_consistency.count(), 1000u);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace hallway::eval
