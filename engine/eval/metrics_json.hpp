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

/// {"count", "rmse", "mean", "median", "max"}; null for none.
nlohmann::ordered_json to_json(const std::optional<ErrorStatistics>& errors);

/// {"translation_m", "rotation_deg"}.
nlohmann::ordered_json to_json(const PathError& error);

/// {"mean", "p50", "p99", "max"}; null for none.
nlohmann::ordered_json to_json(const std::optional<TimeSummary>& times);

}  // namespace hallway::eval
