// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "record/failures.hpp"

namespace hallway::cli {

/// Prints on standard error what a plugin logs as a warning or an error.
void print_plugin_log(const std::string& plugin, std::uint32_t level, const std::string& message);

/// Prints each failure and where it happened on standard error.
void print_failures(const record::Failures& failures);

/// "slam_point 0.1.0" for each plugin of a manifest; of one that ended before it said its version its name alone.
std::vector<std::string> plugin_names(const nlohmann::ordered_json& manifest);

}  // namespace hallway::cli
