// SPDX-License-Identifier: MIT
#include "eval/metrics_json.hpp"

#include <nlohmann/json.hpp>

namespace hallway::eval {
namespace {

using PlaneJson = nlohmann::ordered_json;

PlaneJson errors_json(const std::optional<ErrorSummary>& errors) {
  if (!errors) return nullptr;
  return {{"count", errors->count}, {"mean", errors->mean}, {"rms", errors->rms}, {"max", errors->max}};
}

PlaneJson share_json(const std::optional<double>& share) {
  return share ? PlaneJson(*share) : PlaneJson(nullptr);
}

PlaneJson map_json(const PlaneMapMetrics& map) {
  return {{"mapped", map.mapped},
          {"walls_mapped", map.walls_mapped},
          {"walls_missing", map.walls_missing},
          {"duplicated", map.duplicated},
          {"parts", map.parts},
          {"unmatched", map.unmatched},
          {"aligned_by", map.aligned ? "corners" : "first_pose"},
          {"angle_deg", errors_json(map.angle_deg)},
          {"offset_m", errors_json(map.offset_m)},
          {"corner_m", errors_json(map.corner_m)},
          {"extent_iou",
           {{"mean", share_json(map.extent_iou_mean)}, {"least", share_json(map.extent_iou_least)}}}};
}

}  // namespace

nlohmann::ordered_json to_json(const std::optional<PlaneMetrics>& planes) {
  if (!planes) return nullptr;
  return {{"observations", planes->observations},
          {"associations_none", planes->associations_none},
          {"association_errors", planes->association_errors},
          {"walls_true", planes->walls_true},
          {"online", map_json(planes->online)},
          {"final", map_json(planes->refined)},
          {"position_m", errors_json(planes->position_m)},
          {"heading_deg", errors_json(planes->heading_deg)},
          {"position_refitted_m", errors_json(planes->position_refitted_m)},
          {"heading_refitted_deg", errors_json(planes->heading_refitted_deg)}};
}

}  // namespace hallway::eval
