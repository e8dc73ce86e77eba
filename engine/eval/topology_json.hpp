// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "eval/topology_score.hpp"

namespace hallway::eval {

/// "open", "uncertain", "rightly closed" or "wrongly closed".
std::string_view loop_verdict_name(LoopVerdict verdict);

/// The member `topology` of metrics.json: {"nodes", "openings", "edges", "loop", "came_around"}. Statistics are null where nothing was
/// compared.
nlohmann::ordered_json to_json(const TopologyMetrics& metrics);

}  // namespace hallway::eval
