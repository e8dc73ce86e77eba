// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "host/robot_parts.hpp"

namespace hallway::record {

// What is known of a robot's drive and body and of its sensors, as logs have it; what is not known is null or missing.

nlohmann::ordered_json print_drive(const host::DriveInfo& drive);
nlohmann::ordered_json print_body(const host::BodyInfo& body);
/// Null where nothing is known.
nlohmann::ordered_json print_intrinsics(const host::Intrinsics& intrinsics);

/// Reads the member `drive` or `body` of an activation to the same bits; empty where there is none. Throws Error{kBadInput}, also for what host::problem_of()
/// names; a drive of a kind that is not known here is of an unknown kind.
std::optional<host::DriveInfo> read_drive_in(const nlohmann::ordered_json& activation);
std::optional<host::BodyInfo> read_body_in(const nlohmann::ordered_json& activation);
/// Reads print_intrinsics()'s form. Throws likewise.
/// @param sensor  gets them; has its kind already
void read_intrinsics(const nlohmann::ordered_json& json, host::SensorInfo& sensor);

}  // namespace hallway::record
