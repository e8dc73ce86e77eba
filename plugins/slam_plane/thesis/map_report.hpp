// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/core/types.hpp"
#include "slam_plane/thesis/state.hpp"

namespace hallway::slam_plane::thesis {

/// The map as both modes give it. Planes of one line that share some of it are one wall, which was met first as two parts of which neither told of the other; they are told as one, under the
/// older one's name. The submaps keep both (the thesis merges nothing; Rule 37). O(planes²).
Map report_map(const State& state);

/// The wall that an observation associated with a track belongs to; kNoLandmark while the track is in no submap.
LandmarkId wall_of(TrackId track, const State& state);

/// How sure a pose is, from how many planes tell it. The thesis has no such measure: a rough one.
Mat3 covariance_of(const Alignment& location);

}  // namespace hallway::slam_plane::thesis
