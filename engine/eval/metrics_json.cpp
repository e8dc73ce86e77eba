// SPDX-License-Identifier: MIT
#include "eval/metrics_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace hallway::eval {
namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json number(const std::optional<std::uint64_t>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json aligned(const AlignedRmse& rmse) {
  return {{"first_pose", number(rmse.first_pose)}, {"aligned", number(rmse.aligned)}};
}

Json moving(const std::optional<MovingMetrics>& metrics) {
  if (!metrics) return nullptr;
  return {{"moved", metrics->moved},
          {"moved_marked", metrics->moved_marked},
          {"marked", metrics->marked},
          {"marked_moving", metrics->marked_moving},
          {"recall", number(metrics->recall())},
          {"precision", number(metrics->precision())}};
}

}  // namespace

Json to_json(const std::optional<TimeSummary>& times) {
  if (!times) return nullptr;
  return {{"mean", times->mean}, {"p50", times->p50}, {"p99", times->p99}, {"max", times->max}};
}

Json to_json(const Metrics& metrics) {
  Json landmark_rmse = aligned(metrics.landmark_rmse_m);
  landmark_rmse["final_aligned"] = number(metrics.landmark_rmse_final_aligned_m);
  Json position_rmse = aligned(metrics.position_rmse_m);
  position_rmse["refitted_aligned"] = number(metrics.position_rmse_refitted_aligned_m);
  Json document;
  document["schema"] = "hallway.metrics/1";
  document["iterations"] = metrics.iterations;
  document["lost_iterations"] = metrics.lost_iterations;
  document["observations"] = metrics.observations;
  document["associations_none"] = metrics.associations_none;
  document["association_errors"] = number(metrics.association_errors);
  document["landmarks_true"] = number(metrics.landmarks_true);
  document["landmarks_mapped"] = metrics.landmarks_mapped;
  document["landmarks_duplicated"] = number(metrics.landmarks_duplicated);
  document["landmarks_missed"] = number(metrics.landmarks_missed);
  document["landmarks_unmatched"] = number(metrics.landmarks_unmatched);
  document["moving"] = moving(metrics.moving);
  document["landmark_pairs"] = metrics.landmark_pairs;
  document["landmark_rmse_m"] = std::move(landmark_rmse);
  document["position_pairs"] = metrics.position_pairs;
  document["position_rmse_m"] = std::move(position_rmse);
  document["position_refitted_pairs"] = metrics.position_refitted_pairs;
  document["position_final_m"] = number(metrics.position_final_m);
  document["rotation_rmse_deg"] = aligned(metrics.rotation_rmse_deg);
  document["nees"] = {{"landmarks", number(metrics.landmark_consistency.mean())},
                      {"landmark_pairs", metrics.landmark_consistency.count()},
                      {"poses", number(metrics.pose_consistency.mean())},
                      {"pose_pairs", metrics.pose_consistency.count()}};
  document["planes"] = to_json(metrics.planes);
  document["iteration_ms"] = to_json(metrics.iteration_ms);
  document["iteration_cpu_ms"] = to_json(metrics.iteration_cpu_ms);
  return document;
}

Json without_clock(Json document) {
  document.erase("iteration_ms");
  document.erase("iteration_cpu_ms");
  return document;
}

}  // namespace hallway::eval
