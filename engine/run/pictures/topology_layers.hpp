// SPDX-License-Identifier: MIT
#pragma once

#include "render/picture.hpp"
#include "run/pictures/record.hpp"

namespace hallway::run {

/// Adds a topological map as figure 25 of the thesis has it: discontinuities as circles with an arrow, away from the robot where the wall goes on farther and
/// to it where nearer, as long as the step within limits; sweeps and hallway ends as squares with a circle, rooms and junctions as squares with a triangle;
/// edges as lines; numbers. A node is where the robot truly was at the node's time; without true poses, where the estimated path has it. A node is left out where neither is known.
/// @param T_world_path  where the estimated path is put
void add_topology(render::Picture& picture, const Record& record, const log::Topology& topology,
                  const Pose& T_world_path);

/// The topological map that held at a moment, of a record with a history; null where there was none yet.
const log::Topology* topology_at(const Record& record, const Instant& now);

/// Adds what the plugin drew at a moment, from the log of the record's folder. Nothing where there is no log. Throws Error{kBadInput, kIo}.
void add_drawing(render::Picture& picture, const Record& record, const Instant& now);

}  // namespace hallway::run
