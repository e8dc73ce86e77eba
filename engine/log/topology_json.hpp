// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "log/drawing.hpp"
#include "log/topology.hpp"

namespace hallway::log {

// Topologies and drawings as members of JSON objects: in messages of logs and in topology.json.

/// Adds the members `loop`, `note`, `nodes` and `edges`. Throws Error{kInternal} for a number that is not finite where it must be.
void add_members(const Topology& topology, nlohmann::ordered_json& json);

/// The topology in an object with such members. Throws Error{kBadInput} with the cause, or what the library of JSON throws, where it is none.
Topology topology_of(const nlohmann::json& json);

/// The list of items. Throws as add_members().
nlohmann::ordered_json items_json(const Drawing& drawing);

/// The drawing of a list of items. Throws as topology_of().
Drawing drawing_of(const nlohmann::json& items);

}  // namespace hallway::log
