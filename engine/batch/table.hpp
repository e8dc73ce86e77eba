// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "batch/runner.hpp"

namespace hallway::batch {

/// A text as a field of CSV (RFC 4180), in quotes where it needs them.
std::string csv_field(const std::string& text);

/// The labels of a run, by name.
nlohmann::ordered_json labels_json(const Result& result);

/// The numbers of a metrics.json by their names with points between the levels, in its order: {"a": {"b": 1}} has "a.b".
std::vector<std::pair<std::string, double>> numbers_of(const nlohmann::ordered_json& metrics);

/// The number of that name, if there is one.
std::optional<double> number_of(const nlohmann::ordered_json& metrics, const std::string& name);

/// What a run's metrics say of its path: "ok", "diverged", "lost"; empty where they do not.
std::string path_verdict_of(const Result& result);

/// All results as CSV (RFC 4180): name, labels, status, verdict of a plugin that failed, problem, seconds, verdict of the path, then every metric that one of
/// them has.
std::string print_csv(const std::vector<Result>& results);

/// The same as one JSON document of schema `hallway.batch_results/1`.
nlohmann::ordered_json to_json(const std::vector<Result>& results);

/// What is not as the plan's thresholds want it, one sentence each: a number that is missing, too small or too large, a verdict that is another one. Failed
/// runs miss theirs.
std::vector<std::string> violations(const std::vector<Result>& results, const Plan& plan);

}  // namespace hallway::batch
