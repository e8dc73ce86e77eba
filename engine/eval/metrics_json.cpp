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

/// Of estimates so large that their errors overflow there is no number.
Json finite(double value) {
  return number(std::optional<double>(value));
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

Json parts(const MapParts& parts) {
  return {{"count", parts.count},
          {"restarts", parts.restarts},
          {"scored_iterations", parts.scored_iterations},
          {"other_iterations", parts.other_iterations},
          {"ends_in_scored", parts.ends_in_scored}};
}

Json divergence(const Metrics& metrics) {
  if (!metrics.divergence) return nullptr;
  return {{"position_limit_m", finite(metrics.divergence->limit_m)},
          {"position_worst_m", finite(metrics.divergence->worst_m)},
          {"rotation_worst_deg", number(metrics.divergence->worst_deg)},
          {"iteration", number(metrics.diverged_at)}};
}

}  // namespace

Json to_json(const std::optional<ErrorStatistics>& errors) {
  if (!errors) return nullptr;
  return {{"count", errors->count},
          {"rmse", finite(errors->rmse)},
          {"mean", finite(errors->mean)},
          {"median", finite(errors->median)},
          {"max", finite(errors->max)}};
}

Json to_json(const PathError& error) {
  return {{"translation_m", to_json(error.translation_m)}, {"rotation_deg", to_json(error.rotation_deg)}};
}

Json to_json(const std::optional<TimeSummary>& times) {
  if (!times) return nullptr;
  return {{"mean", times->mean}, {"p50", times->p50}, {"p99", times->p99}, {"max", times->max}};
}

Json to_json(const Metrics& metrics) {
  Json landmark_rmse = aligned(metrics.landmark_rmse_m);
  landmark_rmse["final_aligned"] = number(metrics.landmark_rmse_final_aligned_m);
  Json position_rmse = aligned(metrics.position_rmse_m);
  position_rmse["refitted_aligned"] = number(metrics.position_rmse_refitted_aligned_m);
  return {{"schema", "hallway.metrics/1"},
          {"iterations", metrics.iterations},
          {"lost_iterations", number(metrics.lost_iterations)},
          {"verdict", metrics.verdict ? Json(name_of(*metrics.verdict)) : Json(nullptr)},
          {"coverage",
           {{"poses", number(metrics.pose_coverage())},
            {"landmarks", number(metrics.landmark_coverage())},
            {"walls", number(metrics.wall_coverage())}}},
          {"parts", parts(metrics.parts)},
          {"divergence", divergence(metrics)},
          {"observations", metrics.observations},
          {"associations_none", metrics.associations_none},
          {"association_errors", number(metrics.association_errors)},
          {"associations_dropped", number(metrics.associations_dropped)},
          {"landmarks_true", number(metrics.landmarks_true)},
          {"landmarks_mapped", metrics.landmarks_mapped},
          {"landmarks_duplicated", number(metrics.landmarks_duplicated)},
          {"landmarks_missed", number(metrics.landmarks_missed)},
          {"landmarks_unmatched", number(metrics.landmarks_unmatched)},
          {"moving", moving(metrics.moving)},
          {"landmark_pairs", metrics.landmark_pairs},
          {"landmark_rmse_m", std::move(landmark_rmse)},
          {"position_pairs", metrics.position_pairs},
          {"position_rmse_m", std::move(position_rmse)},
          {"position_refitted_pairs", metrics.position_refitted_pairs},
          {"position_final_m", number(metrics.position_final_m)},
          {"rotation_rmse_deg", aligned(metrics.rotation_rmse_deg)},
          {"rpe",
           {{"frame", to_json(metrics.rpe_frame)},
            {"metre", to_json(metrics.rpe_metre)},
            {"second", to_json(metrics.rpe_second)}}},
          {"nees",
           {{"landmarks", number(metrics.landmark_consistency.mean())},
            {"landmark_pairs", metrics.landmark_consistency.count()},
            {"poses", number(metrics.pose_consistency.mean())},
            {"pose_pairs", metrics.pose_consistency.count()}}},
          {"planes", to_json(metrics.planes)},
          {"iteration_ms", to_json(metrics.iteration_ms)},
          {"iteration_cpu_ms", to_json(metrics.iteration_cpu_ms)}};
}

}  // namespace hallway::eval
