// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "link/description.hpp"

namespace hallway::link {

// What a description of version 2 has behind the structs that its first readers knew: they pass it over. A multiple of 8 bytes.

/// Drive and body; nothing where neither is known.
Bytes robot_parts_bytes(const Description& description);
/// Reads them. Throws BadBytes for less than is said; what is behind them is passed over.
void read_robot_parts(std::span<const std::byte> bytes, Description& description);

/// Intrinsics, rate, latency and growth of noise of a sensor; nothing where nothing is known.
Bytes sensor_parts_bytes(const host::SensorInfo& sensor);
/// Likewise. Intrinsics of a kind that is not known here are passed over.
void read_sensor_parts(std::span<const std::byte> bytes, host::SensorInfo& sensor);

}  // namespace hallway::link
