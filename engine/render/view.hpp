// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "geometry/se3.hpp"
#include "render/renderer.hpp"

namespace hallway::render {

enum class ViewKind {
  kTop,         ///< from straight above without perspective: x to the right, y up, like a map
  kPerspective  ///< from a viewpoint
};

/// The part of the ground that a top view shows.
struct Crop {
  Vec2 centre = Vec2::Zero();  ///< world x and y, metres
  double width_m = 10.0;       ///< across the map area of the picture
};

/// From where a picture is seen, and what draws it. Whatever is not given is chosen so that all content fits.
struct View {
  ViewKind kind = ViewKind::kTop;
  /// Surfaces and patches above this height are cut away, and solids cut by it show a dark section, as in a plan.
  /// Lines, markers and labels are never cut.
  std::optional<double> cut_z_m{};
  std::optional<Crop> crop{};    ///< top view
  std::optional<Vec3> eye{};     ///< perspective: viewpoint, world, metres; needs `target`
  std::optional<Vec3> target{};  ///< perspective: looked at, world, metres
  double vertical_fov = 0.6;     ///< perspective: full angle over the height of the picture's map area, rad
  /// Perspective without `eye`: where the viewer stands, seen from the content: angle about z from the x axis, rad.
  double azimuth = -1.9;
  /// Perspective without `eye`: angle above the horizon, rad.
  double elevation = 0.62;
  Renderer renderer = Renderer::kAuto;  ///< of the faces; a picture without any needs none
};

}  // namespace hallway::render
