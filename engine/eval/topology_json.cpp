// SPDX-License-Identifier: MIT
#include "eval/topology_json.hpp"

#include <nlohmann/json.hpp>

#include "eval/metrics_json.hpp"

namespace hallway::eval {

std::string_view loop_verdict_name(LoopVerdict verdict) {
  switch (verdict) {
    case LoopVerdict::kOpen:
      return "open";
    case LoopVerdict::kUncertain:
      return "uncertain";
    case LoopVerdict::kRightly:
      return "rightly closed";
    case LoopVerdict::kWrongly:
      return "wrongly closed";
  }
  return "";
}

nlohmann::ordered_json to_json(const TopologyMetrics& metrics) {
  return {{"nodes",
           {{"demanded", metrics.demanded},
            {"charted", metrics.charted},
            {"found", metrics.found},
            {"undecided", metrics.undecided},
            {"wrong_kind", metrics.wrong_kind},
            {"missed", metrics.missed},
            {"accepted", metrics.accepted},
            {"duplicates", metrics.duplicates},
            {"false", metrics.false_nodes},
            {"place_m", to_json(metrics.place_m)}}},
          {"openings",
           {{"demanded", metrics.openings},
            {"found", metrics.openings_found},
            {"right_kind", metrics.openings_right}}},
          {"edges",
           {{"compared", metrics.edges},
            {"not_driven", metrics.edges_not_driven},
            {"length_m", to_json(metrics.length_m)}}},
          {"loop", loop_verdict_name(metrics.loop)},
          {"came_around", metrics.came_around}};
}

}  // namespace hallway::eval
