// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/magnetic.h>

#include <cstdint>

#include "host/samples/frame_builder.hpp"

namespace hallway::host {

/// Adds a heading, as FrameBuilder::add() says.
/// @return the numbers, to be filled: nothing known; valid until the next begin()
hw_magnetic_t& add_magnetic(FrameBuilder& builder, std::uint32_t sensor_id);

}  // namespace hallway::host
