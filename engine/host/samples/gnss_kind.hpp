// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/gnss.h>

#include <cstdint>

#include "host/samples/frame_builder.hpp"

namespace hallway::host {

/// Adds a position, as FrameBuilder::add() says.
/// @return the numbers, to be filled: no fix; valid until the next begin()
hw_gnss_t& add_gnss(FrameBuilder& builder, std::uint32_t sensor_id);

}  // namespace hallway::host
