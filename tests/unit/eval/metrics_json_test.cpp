// SPDX-License-Identifier: MIT
#include "eval/metrics_json.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

namespace hallway::eval {
namespace {

Metrics full() {
  Metrics metrics;
  metrics.iterations = 3800;
  metrics.observations = 410484;
  metrics.lost_iterations = 1;
  metrics.verdict = PathVerdict::kDiverged;
  metrics.divergence = Divergence{.limit_m = 0.5, .worst_m = 2, .worst_deg = 8, .first = 3};
  metrics.diverged_at = 12;
  metrics.parts = {2, 1, 2850, 400, false};
  metrics.associations_dropped = 9;
  metrics.rpe_metre = {ErrorStatistics{7, 4, 3, 2, 5}, std::nullopt};
  metrics.landmarks_true = 1145;
  metrics.landmarks_mapped = 1146;
  metrics.landmarks_duplicated = 1;
  metrics.landmarks_missed = 0;
  metrics.landmarks_unmatched = 2;
  metrics.moving = MovingMetrics{4, 3, 2, 0};
  metrics.association_errors = 7;
  metrics.associations_none = 8;
  metrics.landmark_pairs = 1144;
  metrics.landmark_rmse_m = {0.5, 0.25};
  metrics.landmark_rmse_final_aligned_m = 0.125;
  metrics.position_pairs = 3799;
  metrics.position_rmse_m = {0.75, 0.0625};
  metrics.position_rmse_refitted_aligned_m = 0.03125;
  metrics.position_refitted_pairs = 3797;
  metrics.landmark_consistency.add(Eigen::Vector3d(1, 0, 0), Eigen::Matrix3d::Identity() / 3);
  metrics.position_final_m = 1.5;
  metrics.rotation_rmse_deg = {2.5, 3.5};
  PlaneMetrics& planes = metrics.planes.emplace();
  planes.observations = 90;
  planes.associations_none = 5;
  planes.association_errors = 6;
  planes.walls_true = 12;
  planes.online = {
      .mapped = 14, .walls_mapped = 11, .walls_missing = 1, .duplicated = 2, .parts = 4, .unmatched = 3};
  planes.refined = {.mapped = 13,
                    .walls_mapped = 12,
                    .aligned = true,
                    .angle_deg = ErrorSummary{13, 0.5, 0.75, 2},
                    .offset_m = ErrorSummary{13, 0.25, 0.5, 1},
                    .corner_m = ErrorSummary{20, 0.125, 0.25, 0.5},
                    .extent_iou_mean = 0.75,
                    .extent_iou_least = 0.5};
  planes.position_m = ErrorSummary{80, 1, 2, 3};
  planes.position_refitted_m = ErrorSummary{79, 0.5, 1, 1.5};
  metrics.iteration_ms = TimeSummary{1, 2, 3, 4};
  metrics.iteration_cpu_ms = TimeSummary{5, 6, 7, 8};
  return metrics;
}

TEST(MetricsJson, IsTheDocumentedDocument) {
  EXPECT_EQ(
      to_json(full()).dump(),
      R"({"schema":"hallway.metrics/1","iterations":3800,"lost_iterations":1,"verdict":"diverged",)"
      R"("coverage":{"poses":0.75,"landmarks":1.0,"walls":1.0},)"
      R"("parts":{"count":2,"restarts":1,"scored_iterations":2850,"other_iterations":400,"ends_in_scored":false},)"
      R"("divergence":{"position_limit_m":0.5,"position_worst_m":2.0,"rotation_worst_deg":8.0,"iteration":12},)"
      R"("observations":410484,"associations_none":8,"association_errors":7,"associations_dropped":9,)"
      R"("landmarks_true":1145,"landmarks_mapped":1146,)"
      R"("landmarks_duplicated":1,"landmarks_missed":0,"landmarks_unmatched":2,)"
      R"("moving":{"moved":4,"moved_marked":3,"marked":2,"marked_moving":0,"recall":0.75,"precision":0.0},)"
      R"("landmark_pairs":1144,)"
      R"("landmark_rmse_m":{"first_pose":0.5,"aligned":0.25,"final_aligned":0.125},"position_pairs":3799,)"
      R"("position_rmse_m":{"first_pose":0.75,"aligned":0.0625,"refitted_aligned":0.03125},)"
      R"("position_refitted_pairs":3797,"position_final_m":1.5,)"
      R"("rotation_rmse_deg":{"first_pose":2.5,"aligned":3.5},)"
      R"("rpe":{"frame":{"translation_m":null,"rotation_deg":null},)"
      R"("metre":{"translation_m":{"count":7,"rmse":4.0,"mean":3.0,"median":2.0,"max":5.0},"rotation_deg":null},)"
      R"("second":{"translation_m":null,"rotation_deg":null}},)"
      R"("nees":{"landmarks":1.0000000000000002,"landmark_pairs":1,"poses":null,"pose_pairs":0},)"
      R"("planes":{"observations":90,"associations_none":5,"association_errors":6,"walls_true":12,)"
      R"("online":{"mapped":14,"walls_mapped":11,"walls_missing":1,"duplicated":2,"parts":4,"unmatched":3,)"
      R"("aligned_by":"first_pose","angle_deg":null,"offset_m":null,"corner_m":null,)"
      R"("extent_iou":{"mean":null,"least":null}},)"
      R"("final":{"mapped":13,"walls_mapped":12,"walls_missing":0,"duplicated":0,"parts":0,"unmatched":0,)"
      R"("aligned_by":"corners","angle_deg":{"count":13,"mean":0.5,"rms":0.75,"max":2.0},)"
      R"("offset_m":{"count":13,"mean":0.25,"rms":0.5,"max":1.0},)"
      R"("corner_m":{"count":20,"mean":0.125,"rms":0.25,"max":0.5},"extent_iou":{"mean":0.75,"least":0.5}},)"
      R"("position_m":{"count":80,"mean":1.0,"rms":2.0,"max":3.0},"heading_deg":null,)"
      R"("position_refitted_m":{"count":79,"mean":0.5,"rms":1.0,"max":1.5},"heading_refitted_deg":null},)"
      R"("iteration_ms":{"mean":1.0,"p50":2.0,"p99":3.0,"max":4.0},)"
      R"("iteration_cpu_ms":{"mean":5.0,"p50":6.0,"p99":7.0,"max":8.0}})");
}

TEST(MetricsJson, WhatIsUnknownIsNull) {
  const auto document = to_json(Metrics{});
  for (const std::string key :
       {"verdict", "divergence", "association_errors", "associations_dropped", "landmarks_true",
        "landmarks_duplicated", "landmarks_missed", "landmarks_unmatched", "moving", "position_final_m",
        "planes", "iteration_ms", "iteration_cpu_ms"}) {
    EXPECT_TRUE(document.at(key).is_null()) << key;
  }
  for (const std::string key : {"coverage", "landmark_rmse_m", "position_rmse_m", "rotation_rmse_deg"}) {
    for (const auto& [frame, value] : document.at(key).items())
      EXPECT_TRUE(value.is_null()) << key << '.' << frame;
  }
}

TEST(MetricsJson, WhatOverflowedIsNull) {
  Metrics metrics;
  metrics.position_final_m = std::numeric_limits<double>::infinity();
  metrics.landmark_rmse_m.aligned = std::numeric_limits<double>::quiet_NaN();
  metrics.rpe_frame.translation_m = ErrorStatistics{.count = 1, .rmse = metrics.position_final_m.value()};
  const auto document = to_json(metrics);
  EXPECT_TRUE(document.at("rpe").at("frame").at("translation_m").at("rmse").is_null());
  EXPECT_TRUE(document.at("position_final_m").is_null());
  EXPECT_TRUE(document.at("landmark_rmse_m").at("aligned").is_null());
}

TEST(MetricsJson, FactsOfTheClockAreInTwoKeysAlone) {
  Metrics slower = full();
  slower.iteration_ms->mean = 99.0;
  slower.iteration_cpu_ms = std::nullopt;
  auto one = to_json(full()), other = to_json(slower);
  EXPECT_NE(one, other);
  for (const char* key : {"iteration_ms", "iteration_cpu_ms"}) {
    EXPECT_EQ(one.erase(key), 1u);
    EXPECT_EQ(other.erase(key), 1u);
  }
  EXPECT_EQ(one, other);
}

}  // namespace
}  // namespace hallway::eval
