// SPDX-License-Identifier: MIT
#pragma once

#include "render/picture.hpp"
#include "run/pictures/record.hpp"
#include "sim/scenario.hpp"

namespace hallway::run {

/// Adds what a run's map of planes shows, as the figures of thesis chapters 4 and 5 do: the mapped planes over the true planes, dots at the ends that
/// are certain, and of each submap a star from its origin to the planes in it. Nothing where the run mapped none.
/// @param T_world_map  where the map is put
void add_planes(render::Picture& picture, const Record& record, const sim::PictureSpec& spec,
                const Pose& T_world_map);

}  // namespace hallway::run
