// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "map/document.hpp"
#include "map/entities.hpp"

namespace hallway::map {

/// A robot start and a path that begins elsewhere. A robot on a path begins where the path does, so the start has no effect.
struct StartOffPath {
  RobotStart start;
  std::string path;       ///< name
  Pose T_world_begin;     ///< where the path begins, x along it
  double distance_m = 0;  ///< between the two
};

/// Compares the map's default robot start (default_robot_start()) with the beginning of one path; empty where they agree within a centimetre on the ground and a metre in
/// height, or the map has no such start. A
/// closed path with a rounded corner at its first waypoint agrees with a start at that waypoint too. Headings are not compared.
/// Throws Error{kBadInput} as default_robot_start() and find_path() do.
std::optional<StartOffPath> start_off_path(const Document& document, std::string_view path);

/// The same for a map whose path is not chosen yet: empty where any path begins at the start or cannot be made; else the path that
/// begins nearest. Looks at the first kMostPathsChecked paths. Never throws for what a document holds.
std::optional<StartOffPath> start_off_all_paths(const Document& document);

/// "the robot start is at (1, 1, 0.2), but path `round` begins at (2, 1.5, 0.3), 1.12 m away: a robot on the path begins there, and the
/// start has no effect". Metres; safe to print.
std::string start_off_path_text(const StartOffPath& found);

}  // namespace hallway::map
