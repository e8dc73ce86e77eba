// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "world/compiled_world.hpp"

namespace hallway::cli {

/// Where a map leaks, as lines of text; `way_file` is named where one was written.
std::string leak_text(const world::CompiledWorld& world, const std::string& way_file);

/// The same as JSON: null where there is no way into the void.
nlohmann::ordered_json leak_json(const world::CompiledWorld& world);

/// The way of a leak as Quake's tools write it (`.pts`): a point in map units on each line, at most half a metre apart, from the
/// occupant into the void.
std::string way_points(const bsp::Leak& leak, double metres_per_unit);

}  // namespace hallway::cli
