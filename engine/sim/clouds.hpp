// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "map/document.hpp"
#include "sim/scenario.hpp"
#include "sim/table_reader.hpp"

namespace hallway::sim {

/// The keys that a scenario's table `[cloud.NAME]` sets, as a map would have them. Ranges are those of the map's class
/// `hw_landmark_cloud`. Throws Error for a value that is wrong, as TableReader does.
std::vector<map::KeyValue> read_cloud_keys(TableReader& cloud);

/// Sets the keys in the clouds of those names. Throws Error{kBadInput} with the scenario's line for a cloud that the map does
/// not have.
void set_cloud_keys(std::span<const CloudSpec> clouds, map::Document& document);

}  // namespace hallway::sim
