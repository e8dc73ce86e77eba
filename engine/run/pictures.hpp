// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "render/image.hpp"
#include "render/picture.hpp"
#include "run/record.hpp"
#include "sim/scenario.hpp"

namespace hallway::run {

/// A picture of a run: the map, true and estimated path, true and mapped landmarks with lines between, submaps, and what
/// the sensor saw at the end. Estimates are drawn where the best rigid fit to the truth puts them. Errors too small to be
/// seen are drawn longer, by a power of ten that the legend states.
render::Picture compose_picture(const Record& record, const sim::PictureSpec& spec);

/// A picture of a map alone.
/// @param title  e.g. the map's name
render::Picture compose_map_picture(const map::World& world, const std::string& title);

/// Draws and encodes a picture of a run; opens closed buildings in a top view unless the picture's description says how.
/// @return the bytes of a PNG file
std::string draw_run_picture(const Record& record, const sim::PictureSpec& spec);

/// The same for a map alone.
std::string draw_map_picture(const map::World& world, const std::string& title, const sim::PictureSpec& spec);

}  // namespace hallway::run
