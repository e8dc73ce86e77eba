// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "drive/spec.hpp"
#include "host/robot_parts.hpp"
#include "sim/driven_world.hpp"

namespace hallway::sim {

/// What plugins are told of a drive: kind, geometry, limits, latency and dead bands; not its noise and slip.
host::DriveInfo describe(const drive::DriveSpec& spec);

/// What they are told of the body of a robot with a drive. Places along z are rounded to nanometres.
host::BodyInfo describe_body(const DrivenWorld& world);

/// The wheels that encoders count, in the order of their readings; the body's frame.
/// @param m_per_tick  as plugins know it
std::vector<host::EncoderWheel> describe_wheels(const drive::DriveSpec& spec, const DrivenWorld& world,
                                                double m_per_tick);

}  // namespace hallway::sim
