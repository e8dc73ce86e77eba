// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "eval/topology_score.hpp"

namespace hallway::eval {

/// The member `topology` of metrics.json: {"nodes", "openings", "edges", "loop", "came_around"}. Statistics are null where nothing was
/// compared.
nlohmann::ordered_json to_json(const TopologyMetrics& metrics);

}  // namespace hallway::eval
