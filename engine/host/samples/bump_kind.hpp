// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/bump.h>

#include <cstdint>
#include <vector>

#include "host/samples/frame_builder.hpp"

namespace hallway::host {

/// Adds a reading of contact zones, as FrameBuilder::add() says.
/// @return the empty list to be filled with all zones of the sensor, ascending; valid until the next begin()
std::vector<hw_bump_zone_t>& add_bump(FrameBuilder& builder, std::uint32_t sensor_id);

}  // namespace hallway::host
