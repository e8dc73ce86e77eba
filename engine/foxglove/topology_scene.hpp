// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>

#include "foxglove/messages.hpp"
#include "foxglove/seen_place.hpp"
#include "log/drawing.hpp"
#include "log/topology.hpp"

namespace hallway::foxglove {

/// A topological map as figure 25 of the thesis has it: discontinuities as circles with an arrow away from the robot or to it, as long as the step within
/// limits; sweeps and hallway ends as squares with a circle, rooms and junctions as squares with a triangle; edges as lines; numbers.
/// @param frame   of the places
/// @param places  of the nodes; what has none is not shown, nor are its edges
Entity topology_graph(const std::string& frame, const log::Topology& topology,
                      std::span<const std::optional<SeenPlace>> places);

/// A drawing of a plugin, in the body's frame of this name.
Entity drawing_scene(const std::string& frame, const log::Drawing& drawing);

}  // namespace hallway::foxglove
