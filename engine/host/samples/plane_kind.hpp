// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/planes.h>

#include <cstdint>
#include <vector>

#include "host/samples/frame_builder.hpp"
#include "host/samples/payload.hpp"
#include "host/samples/plane_lists.hpp"

namespace hallway::host {

/// The planes of a reading that is made, and what their hulls are made of (hw_plane_t.first_hull).
struct PlaneReading {
  std::vector<hw_plane_t>& planes;
  std::vector<hw_point3_t>& hull_points;
};

/// Adds a reading of planes that a sensor gives itself, as FrameBuilder::add() says.
/// @return the empty lists to be filled, sensor frame, metres; valid until the next begin()
PlaneReading add_planes(FrameBuilder& builder, std::uint32_t sensor_id);

/// The payload of planes that were found in sample `found_in` of a frame; refers to `list`.
void fill_found(const PlaneList& list, std::uint32_t found_in, Payload& payload);

}  // namespace hallway::host
