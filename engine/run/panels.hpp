// SPDX-License-Identifier: MIT
#pragma once

#include "render/image.hpp"
#include "render/renderer.hpp"
#include "run/record.hpp"
#include "sim/scenario.hpp"

namespace hallway::run {

/// A run of points in which planes were found, in four panels as the figures of thesis chapter 5: the mapped walls over the true ones; the points that
/// one frame saw; the planes found in them over the walls; the map by itself, with its submaps' links and its walls' numbers. The frame is the first of
/// those in which the most planes were found. What the run folder does not have is not shown.
/// @param spec  the size of the whole; its view and layers are not read
render::Image draw_panels(const Record& record, const sim::PictureSpec& spec, render::Renderer renderer);

}  // namespace hallway::run
