// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "planes/score.hpp"
#include "render/image.hpp"
#include "render/view.hpp"

namespace hallway::planes {

/// Of points that belong to no plane.
inline constexpr render::Rgb kNoPlaneColour{178, 180, 184};

/// How large a picture is: of one map area; two stand side by side where truth is shown beside a result.
struct PictureSize {
  int width_px = 1000;
  int height_px = 800;
};

/// What a picture shows.
struct PictureContent {
  const std::vector<Vec3>& points;
  const std::vector<PlaneObservation>& found;
  std::string title{};
  std::string subtitle{};
};

/// The points, coloured by plane, and the rectangles of what was found. At most 60 000 points are drawn, each n-th. Throws as render::draw() does.
render::Image draw_planes(const PictureContent& content, const render::View& view, const PictureSize& size);

/// On the left what is true, on the right what was found, from the same direction; pairs have one colour, and faults are named at the planes that they are of.
render::Image draw_comparison(const PictureContent& content, const Truth& truth, const Score& score,
                              const render::View& view, const PictureSize& size);

}  // namespace hallway::planes
