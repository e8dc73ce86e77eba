// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/odometry.h>

#include <cstdint>

#include "host/samples/frame_builder.hpp"

namespace hallway::host {

/// Adds a reading of motion as a sensor reckons it, as FrameBuilder::add() says.
/// @return the numbers, to be filled: at the start, nothing known; valid until the next begin()
hw_odometry_t& add_odometry(FrameBuilder& builder, std::uint32_t sensor_id);

}  // namespace hallway::host
