// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "batch/plan.hpp"

namespace hallway::batch {

/// A JSON object from a file; null where there is none, or what is there is none.
nlohmann::ordered_json json_file(const std::filesystem::path& file);

/// Stands for what decides what a run of a cell gives and is known before it: program, arguments, pictures, and the content of the files that the plan names.
std::string cell_hash(const Cell& cell, const Plan& plan, const std::string& program_hash);

/// Whether the files that a run has read, by its run.json, still have the content that they had then: scenario, map, models, logs and plugins. False
/// where it does not say.
bool reads_the_same(const Cell& cell, const nlohmann::ordered_json& run);

}  // namespace hallway::batch
