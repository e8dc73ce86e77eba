// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geom/box.hpp"
#include "render/camera.hpp"
#include "render/picture.hpp"
#include "run/pictures/record.hpp"

namespace hallway::run {

/// The part of the world that pictures of a run show: the surfaces of the map and what is true in it, with a margin. Where there are neither surfaces nor true landmarks or
/// planes, as far around the true path as the sensor sees. Empty where nothing is true: then nothing is cut off.
Box frame_of(const Record& record, const std::vector<render::Surface>& surfaces);

/// The crop of a top view that shows a frame in a map area, whatever else is in the picture. The frame must not be empty.
render::Crop crop_of(const Box& frame, const render::PixelRect& area);

/// Cuts lines and marks off at the border of a frame, so that an estimate far away does not make the map small. A line in the legend says how many points
/// of its line are outside. Surfaces, the frustum and what lies inside stay as they are.
void cut_to(const Box& frame, render::Picture& picture);

}  // namespace hallway::run
