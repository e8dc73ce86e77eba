// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/pose.h>

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "host/stage.hpp"

namespace hallway::record {

/// A sensor's facts as they stand in run.json; what is not known is null.
nlohmann::ordered_json print_sensor(const host::SensorInfo& sensor);
nlohmann::ordered_json print_sensors(std::span<const host::SensorInfo> sensors);
/// Reads print_sensor()'s form to the same bits. Throws Error{kBadInput}.
host::SensorInfo read_sensor(const nlohmann::ordered_json& json);
/// Reads the sensors of a log, which have their ids. Throws Error{kBadInput}.
std::vector<host::SensorInfo> read_sensors(const nlohmann::ordered_json& json);

/// A pose as it stands in run.json: {"position_m": [x, y, z], "orientation_wxyz": [w, x, y, z]}.
nlohmann::ordered_json print_pose(const hw_pose_t& pose);
/// Reads print_pose()'s form to the same bits. Throws Error{kBadInput}.
hw_pose_t read_pose(const nlohmann::ordered_json& json);

}  // namespace hallway::record
