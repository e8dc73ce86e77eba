// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/camera.hpp"
#include "render/image.hpp"
#include "render/picture.hpp"
#include "render/view.hpp"

namespace hallway::render {

/// What the faces look like through a camera: a grid of samples, `factor` by `factor` in each pixel of `area`, rows from
/// top to bottom.
struct SurfaceLayer {
  PixelRect area;
  int factor = 1;
  int width = 0;   ///< samples in a row
  int height = 0;  ///< rows of samples
  std::vector<Rgb> colour;
  std::vector<Eigen::Vector3f> normal;  ///< world, unit length; zero where there is nothing
  std::vector<float> distance_m;        ///< along the viewing direction; infinity where there is nothing
  std::vector<std::uint8_t> cut;        ///< 1 where a solid is cut open

  std::size_t index(int x, int y) const { return pixel_index(x, y, width); }
};

/// Draws the faces, textured where they have a picture, lit by a sky and a sun, with 4-fold multisampling at `factor` times the resolution of the picture.
/// What lies above `view.cut_z_m` is left out, and the insides of cut solids are filled with palette::kCut. Throws NoRenderer if this
/// machine does not have `view.renderer`.
SurfaceLayer render_surfaces(const std::vector<Surface>& surfaces, const Camera& camera,
                             const PixelRect& area, int factor, const View& view);

}  // namespace hallway::render
