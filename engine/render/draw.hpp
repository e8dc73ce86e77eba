// SPDX-License-Identifier: MIT
#pragma once

#include "render/camera.hpp"
#include "render/image.hpp"
#include "render/picture.hpp"
#include "render/view.hpp"

namespace hallway::render {

/// Draws a picture: the content in the map area, the title above it, legend and scale bar below it. The same input gives
/// the same bytes on one machine, whatever the number of threads.
///
/// Throws Error{kBadInput} for a size that check_image_size() refuses or a view that make_camera() refuses, Error{kIo} if the
/// fonts are missing, and NoRenderer where there are surfaces to draw and this machine does not have the view's renderer.
/// O(pixels + content).
Image draw(const Picture& picture, const View& view, int width_px, int height_px);

/// The map area that draw() uses: the picture without title, legend and scale bar, which small pictures do without.
PixelRect map_area(const Picture& picture, int width_px, int height_px);

/// The camera that draw() uses: tells which pixel a world point falls on.
Camera picture_camera(const Picture& picture, const View& view, int width_px, int height_px);

}  // namespace hallway::render
