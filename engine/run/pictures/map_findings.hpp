// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "map/check.hpp"
#include "map/document.hpp"

namespace hallway::run {

/// Names of the findings that find_faults() has beside map::finding_ids(), sorted.
const std::vector<std::string>& world_finding_ids();

/// All that can be said of a map: what map::check() finds, and what shows once it is compiled: occupants in solid, paths through walls,
/// waypoints that no opening leads to, doors and windows that lead nowhere, a leak. Ordered by line, id and message. Throws nothing for what a document holds. Costs a compilation without visible sets.
std::vector<map::Finding> find_faults(const map::Document& document);

}  // namespace hallway::run
