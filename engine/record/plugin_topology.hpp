// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "host/output/drawing.hpp"
#include "host/output/topology.hpp"
#include "log/drawing.hpp"
#include "log/topology.hpp"

namespace hallway::record {

/// A topological map of the ABI as files have it.
log::Topology copy_topology(const host::Topology& topology);

/// A drawing of the ABI as files have it.
log::Drawing copy_drawing(const host::Drawing& drawing);

/// The member `topology` of run.json (docs/formats.md).
nlohmann::ordered_json describe_topology(const log::Topology& topology);

}  // namespace hallway::record
