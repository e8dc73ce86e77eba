// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "batch/runner.hpp"

namespace hallway::cli {

/// Results beside each other for people: errors, times and verdicts, a line each.
std::string results_table(const std::vector<batch::Result>& results);

/// Why runs failed, and which thresholds were missed; empty where there is nothing of either.
std::string failures_text(const std::vector<batch::Result>& results,
                          const std::vector<std::string>& violations);

}  // namespace hallway::cli
