// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/stage.hpp"
#include "link/datagram.hpp"

namespace hallway::link {

inline constexpr std::size_t kMaxSensors = 64;
/// Of the robot's name, and of a sensor's.
inline constexpr std::size_t kMaxNameBytes = 255;

/// What a robot says of itself.
struct Description {
  bool lock_step = false;      ///< time is the robot's own: it waits for the answer to each frame
  std::int64_t period_ns = 0;  ///< from frame to frame; 0 where it is not regular
  std::string name;
  std::vector<host::SensorInfo> sensors{};
  std::optional<host::DriveInfo> drive{};  ///< unset: not known
  std::optional<host::BodyInfo> body{};    ///< unset: not known
};

/// The message that says it, in a version of the protocol; version 1 says nothing of drive, body and intrinsics. Throws Error{kBadInput} for what read_description() would refuse.
Bytes write_description(const Description& description, std::uint8_t version);

/// Reads it. From version 2 on its structs may be larger than these; what is not known is passed over. Throws Error{kBadInput}: less or more than it says, more than kMaxSensors sensors, ids that stand twice, names that are too long or
/// no plain UTF-8, a mount that is no pose, a period below 0, and what host::problem_of() names of drive, body and intrinsics.
Description read_description(std::span<const std::byte> message, std::uint8_t version);

}  // namespace hallway::link
