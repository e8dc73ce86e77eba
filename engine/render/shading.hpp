// SPDX-License-Identifier: MIT
#pragma once

#include "render/canvas.hpp"
#include "render/surface_pass.hpp"

namespace hallway::render {

/// Darkens places that little of the sky reaches (corners, the feet of walls): for each sample the share of nearby points
/// above its face that other faces hide, after Mittring, "Finding next gen: CryEngine 2" (2007), in metres instead of
/// pixels, smoothed without crossing edges. O(samples), the same for any number of threads.
void darken_corners(SurfaceLayer& layer, const Camera& camera, unsigned threads);

/// Draws thin lines where faces bend or end.
void outline_faces(SurfaceLayer& layer, unsigned threads);

/// Averages the samples of each pixel into `image`, leaving alone the pixels where no face is.
void copy_to_image(const SurfaceLayer& layer, Image& image);

/// The distances that hide lines behind the faces: of each pixel, that of its farthest sample.
Occluders make_occluders(const SurfaceLayer& layer);

}  // namespace hallway::render
