// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "host/samples/plane_kind.hpp"
#include "host/samples/plane_lists.hpp"
#include "log/plane_observations.hpp"

namespace hallway::record {

/// A plane as tables have it: without hull and members.
log::PlaneObservation plane_observation(const hw_plane_t& plane);

/// A plane of a checked sample, with its hull.
/// @param i  below planes.count
log::PlaneObservation plane_observation(const hw_planes_t& planes, std::uint64_t i);

/// The reverse: adds an observation, with its hull, to a reading that is made.
void add_plane(const host::PlaneReading& reading, const log::PlaneObservation& seen);

/// The planes of a sample as logs have them, with hulls and members, in their order.
std::vector<log::PlaneObservation> plane_observations(const host::PlaneList& list);

}  // namespace hallway::record
