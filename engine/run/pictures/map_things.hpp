// SPDX-License-Identifier: MIT
#pragma once

#include "map/document.hpp"
#include "render/picture.hpp"
#include "world/compiled_world.hpp"

namespace hallway::run {

/// What a picture of a map shows of its entities.
struct MapThings {
  bool start = true;  ///< where the robot begins, and its heading
  bool paths = true;  ///< all of them, by name
  bool sensors =
      true;  ///< fields of view at the robot's start, or at the first path's; drawn 2 m long at most
  bool lights = true;
  bool rooms = true;  ///< names of rooms that the editor has made
};

/// Adds the things of a map to its picture. What is wrong in the map is left out: `hallway map check` names that.
/// @param world  of the document
void add_map_things(render::Picture& picture, const map::Document& document,
                    const world::CompiledWorld& world, const MapThings& things);

}  // namespace hallway::run
