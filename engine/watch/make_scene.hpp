// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "run/pictures/record.hpp"
#include "run/sources/source.hpp"
#include "sim/simulator.hpp"
#include "watch/scene.hpp"

namespace hallway::watch {

/// The scene of a run that is to begin.
/// @param manifest  run.json, for the name and the body. Throws Error{kBadInput} for a body that is none.
Scene scene_of(const sim::Simulator& simulator, const run::Source& source,
               const nlohmann::ordered_json& manifest);

/// The scene of a run's folder, with what was mapped. A model of the map that the folder lacks is not in the plan. Throws Error{kBadInput, kIo}.
Scene scene_of(const run::Record& record);

}  // namespace hallway::watch
