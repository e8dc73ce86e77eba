// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/core/types.hpp"
#include "slam_plane/thesis/state.hpp"

namespace hallway::slam_plane::thesis {

/// The map as both modes give it. A plane that lies within another one with more sightings is left out: the two are one wall (Rule 37).
Map report_map(const State& state);

/// The wall that a piece taken for a track belongs to; kNoWall while the track is in no submap.
WallId wall_of(TrackId track, const State& state);

/// Planes in the map.
std::uint64_t count_walls(const State& state);

/// How sure a pose is, from how many planes tell it. The thesis has no such measure: a rough one.
Mat3 covariance_of(const Alignment& location);

}  // namespace hallway::slam_plane::thesis
