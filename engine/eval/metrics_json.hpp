// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "eval/metrics.hpp"

namespace hallway::eval {

/// The document `metrics.json`, "schema": "hallway.metrics/1" (docs/metrics.md). Members always stand in the same order;
/// what could not be computed is null.
nlohmann::ordered_json to_json(const Metrics& metrics);

/// The member `planes`; null for none.
nlohmann::ordered_json to_json(const std::optional<PlaneMetrics>& planes);

/// {"mean", "p50", "p99", "max"}; null for none.
nlohmann::ordered_json to_json(const std::optional<TimeSummary>& times);

/// The document without the facts of clock and machine (`iteration_ms`, `iteration_cpu_ms`): what two runs of one input
/// have in common.
nlohmann::ordered_json without_clock(nlohmann::ordered_json document);

}  // namespace hallway::eval
