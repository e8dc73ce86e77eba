// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/imu.h>

#include <cstdint>

#include "host/samples/frame_builder.hpp"

namespace hallway::host {

/// Adds a reading of angular velocity and specific force, as FrameBuilder::add() says.
/// @return the numbers, to be filled: nothing known; valid until the next begin()
hw_imu_t& add_imu(FrameBuilder& builder, std::uint32_t sensor_id);

}  // namespace hallway::host
