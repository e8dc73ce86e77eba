// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "batch/runner.hpp"

namespace hallway::batch {

/// The numbers of a metrics.json by their names with points between the levels, in its order: {"a": {"b": 1}} has "a.b".
std::vector<std::pair<std::string, double>> numbers_of(const nlohmann::ordered_json& metrics);

/// The number of that name, if there is one.
std::optional<double> number_of(const nlohmann::ordered_json& metrics, const std::string& name);

/// All results as CSV (RFC 4180): name, labels, status, verdict, problem, seconds, then every metric that one of them has.
std::string print_csv(const std::vector<Result>& results);

/// The same as one JSON document of schema `hallway.batch_results/1`.
nlohmann::ordered_json to_json(const std::vector<Result>& results);

/// What is not as the thresholds want it, one sentence each: a number that is missing, too small or too large. Failed runs miss theirs.
std::vector<std::string> violations(const std::vector<Result>& results,
                                    const std::vector<Threshold>& thresholds);

}  // namespace hallway::batch
