// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geom/polygon.hpp"
#include "geom/pose.hpp"
#include "render/colour.hpp"

namespace hallway::render {

/// One face of a closed solid, seen from the side that its normal points to.
struct Surface {
  Polygon polygon{};  ///< world, metres
  Rgb colour{};
};

/// A line through points, e.g. a path.
struct Polyline {
  std::vector<Vec3> points{};  ///< world, metres; a point that is not finite breaks the line
  Rgb colour{};
  double width_px = 2.0;
  bool dashed = false;
  std::string label{};  ///< text in the legend, empty for none
};

enum class MarkerShape { kDot, kRing, kCross, kDiamond, kSquare };

/// The same mark at many places, e.g. landmarks.
struct Markers {
  std::vector<Vec3> positions{};  ///< world, metres; those that are not finite are left out
  MarkerShape shape = MarkerShape::kDot;
  Rgb colour{};
  double size_px = 5.0;  ///< diameter
  std::string label{};   ///< text in the legend, empty for none
};

/// Many separate lines, e.g. from true landmarks to mapped ones or from a submap to its members.
struct Segments {
  std::vector<std::array<Vec3, 2>>
      pairs{};  ///< world, metres; those with an end that is not finite are left out
  Rgb colour{};
  double width_px = 1.0;
  double opacity = 1.0;  ///< 0 to 1, of the whole bundle: crossing lines do not add up
  std::string label{};   ///< text in the legend, empty for none
};

/// Where a robot stands and what a sensor of it can see.
struct FrustumMark {
  Pose T_world_sensor{};        ///< x is the viewing direction
  double horizontal_fov = 1.0;  ///< full angle, rad
  double vertical_fov = 1.0;    ///< full angle, rad
  double range_m = 1.0;
  Rgb colour = palette::kSensor;
  std::string label{};  ///< text in the legend, empty for none
};

/// A text at a place; it is moved a little where it would cover another one, and left out where it would still.
struct Label {
  Vec3 position = Vec3::Zero();  ///< world, metres
  std::string text{};
  Rgb colour = palette::kInk;
};

/// Everything that a picture shows, as plain data. Drawn in this order: surfaces, frustum, segments, polylines, markers,
/// labels; within a list, later ones cover earlier ones. Things of one label and one list share a line of the legend.
struct Picture {
  std::string title{};
  std::string subtitle{};  ///< smaller, after the title
  std::vector<Surface> surfaces{};
  std::optional<FrustumMark> frustum{};
  std::vector<Segments> segments{};
  std::vector<Polyline> polylines{};
  std::vector<Markers> markers{};
  std::vector<Label> labels{};
};

}  // namespace hallway::render
