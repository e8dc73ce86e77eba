// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "geometry/se3.hpp"
#include "map/document.hpp"

namespace hallway::map {

/// Something that stands in the world and must therefore be inside of what its brushes enclose.
struct Occupant {
  std::string classname{};
  std::string
      name{};  ///< its `name` or `targetname`, of a waypoint the path and index; empty where it has none
  Vec3 position_m = Vec3::Zero();
  int entity = 0;  ///< index in Document::entities
  int line = 0;
};

/// All entities with an origin and without brushes, in the order of the file, except for those whose place means nothing:
/// `info_null` and `info_notnull` (points that lights aim at), sensors (which are on the robot), references to models and other maps
/// (`hw_mesh`, `misc_model`, `misc_external_map…`).
///
/// Throws Error{kBadInput} for an origin that is not three numbers, and where a class of Hallway's that needs one has none.
std::vector<Occupant> occupants(const Document& document);

}  // namespace hallway::map
