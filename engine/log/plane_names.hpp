// SPDX-License-Identifier: MIT
#pragma once

/// Names in files and logs that are older than the names of the glossary, and stay: users have such files. What they hold is a TruePlane.
namespace hallway::log::plane_names {

inline constexpr const char* kTruePlanesFile = "true_walls.csv";
inline constexpr const char* kTruePlanesTopic = "/hallway/truth/walls";
inline constexpr const char* kTruePlanesKey = "walls";      ///< of a message of that topic
inline constexpr const char* kTruePlaneColumn = "wall_id";  ///< of true_walls.csv and observed_planes.csv

}  // namespace hallway::log::plane_names
