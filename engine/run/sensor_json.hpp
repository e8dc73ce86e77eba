// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "geom/pose.hpp"
#include "host/plugin.hpp"

namespace hallway::run {

/// A pose as the ABI has it.
hw_pose_t abi_pose(const Pose& pose);
/// A pose of the ABI, to the same bits.
Pose pose_of(const hw_pose_t& pose);

/// A sensor's facts as they stand in run.json; what is not known is null.
nlohmann::ordered_json print_sensor(const host::SensorInfo& sensor);
/// Reads print_sensor()'s form to the same bits. Throws Error{kBadInput}.
host::SensorInfo read_sensor(const nlohmann::ordered_json& json);

/// A pose as it stands in run.json: {"position_m": [x, y, z], "orientation_wxyz": [w, x, y, z]}.
nlohmann::ordered_json print_pose(const Pose& pose);
/// Reads print_pose()'s form to the same bits. Throws Error{kBadInput}.
Pose read_pose(const nlohmann::ordered_json& json);

}  // namespace hallway::run
