// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace hallway::sim {

/// The keys of a scenario's tables. What they mean stands in docs/formats.md.
inline const std::vector<std::string> kTopKeys{
    "schema", "map",    "seed",  "steps",    "period_s", "call_timeout_s", "memory_limit_mib", "on_failure",
    "robot",  "sensor", "cloud", "material", "event",    "plugin",         "picture"};
inline const std::vector<std::string> kRobotKeys{"path",     "speed_m_s", "loop_steps", "smooth",
                                                 "radius_m", "length_m",  "width_m",    "bottom_m",
                                                 "top_m",    "start",     "drive",      "file"};
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
