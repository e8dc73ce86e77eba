// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/encoder.h>

#include <cstdint>
#include <vector>

#include "host/samples/frame_builder.hpp"

namespace hallway::host {

/// Adds a reading of wheel encoders, as FrameBuilder::add() says.
/// @return the empty list to be filled with the counts of all wheels of the sensor; valid until the next begin()
std::vector<hw_wheel_ticks_t>& add_encoder(FrameBuilder& builder, std::uint32_t sensor_id);

}  // namespace hallway::host
