// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace hallway::sim {

/// The keys of a scenario's tables. What they mean stands in docs/formats.md.
inline const std::vector<std::string> kTopKeys{
    "schema",     "map",   "seed",   "steps", "period_s", "call_timeout_s", "memory_limit_mib",
    "on_failure", "robot", "sensor", "cloud", "event",    "plugin",         "picture"};
inline const std::vector<std::string> kRobotKeys{"path",     "speed_m_s", "loop_steps", "radius_m",
                                                 "length_m", "width_m",   "bottom_m",   "top_m",
                                                 "start",    "drive",     "file"};
/// By kind of sensor, in the order of map::entity_schema()'s kinds.
inline const std::vector<std::string> kPointSensorKeys{
    "kind",        "horizontal_fov_deg", "vertical_fov_deg", "min_range_m", "max_range_m", "noise_m",
    "noise_per_m", "position_m",         "yaw_deg",          "pitch_deg",   "roll_deg",    "rate_hz",
    "phase_s",     "latency_s"};
inline const std::vector<std::string> kPlaneSensorKeys{
    "kind",          "horizontal_fov_deg", "vertical_fov_deg", "min_range_m", "max_range_m",
    "bounded_sides", "occlusion",          "min_length_m",     "noise_m",     "noise_angle_deg",
    "noise_end_m",   "position_m",         "yaw_deg",          "rate_hz",     "phase_s",
    "latency_s"};
/// Of scenarios alone.
inline const std::vector<std::string> kFaceSensorKeys{"kind",
                                                      "horizontal_fov_deg",
                                                      "vertical_fov_deg",
                                                      "min_range_m",
                                                      "max_range_m",
                                                      "occlusion",
                                                      "min_length_m",
                                                      "noise_m",
                                                      "noise_angle_deg",
                                                      "noise_end_m",
                                                      "position_m",
                                                      "yaw_deg",
                                                      "pitch_deg",
                                                      "roll_deg",
                                                      "rate_hz",
                                                      "phase_s",
                                                      "latency_s"};
inline const std::vector<std::string> kBumpSensorKeys{
    "kind", "zones", "depth", "skin_m", "missed_rate", "false_rate", "rate_hz", "phase_s", "latency_s"};
inline const std::vector<std::string> kEncoderSensorKeys{
    "kind", "ticks_per_revolution", "radius_error_sigma", "rate_hz", "phase_s", "latency_s"};
/// Of sensors of all kinds, in scenarios alone.
inline constexpr const char* kMounted = "mounted";
inline const std::vector<std::string> kCloudKeys{"per_100m", "sideways_m",   "height_m", "seed",
                                                 "speed",    "moving_share", "motion",   "groups"};
inline const std::vector<std::string> kPictureKeys{"file",  "view",     "width_px", "height_px", "cut_z_m",
                                                   "eye_m", "target_m", "show",     "iteration", "every"};

/// Those at the top that the command line may set as they are.
inline const std::vector<std::string> kTopOverrideKeys{
    "map", "seed", "steps", "period_s", "call_timeout_s", "memory_limit_mib", "on_failure"};

}  // namespace hallway::sim
