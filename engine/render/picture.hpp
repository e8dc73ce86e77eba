// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geom/polygon.hpp"
#include "geometry/se3.hpp"
#include "render/colour.hpp"
#include "render/texture.hpp"

namespace hallway::render {

/// What a face is part of.
enum class SurfaceKind {
  kSolid,  ///< the boundary of something closed; seen from the side that its normal points to, filled where it is cut
  kUnseen,  ///< the same, but not shown: it only closes what is cut
  kSheet,   ///< nothing closed; seen from both sides
};

/// One flat face.
struct Surface {
  Polygon polygon{};  ///< world, metres; convex
  Rgb colour{};
  SurfaceKind kind = SurfaceKind::kSolid;
  std::shared_ptr<const Texture> texture{};  ///< multiplies the colour; none for a face of one colour
  /// Where each vertex lies on the texture: (0, 0) is its top left corner, (1, 1) its bottom right one. A face whose
  /// coordinates are not finite, or not as many as its vertices, is drawn without a texture.
  std::vector<std::array<float, 2>> uv{};
};

/// Flat areas that let through what lies behind them, e.g. portals. View::cut_z_m cuts them as it does surfaces.
struct Patches {
  std::vector<std::vector<Vec3>> polygons{};  ///< world, metres; each convex and in one plane
  Rgb colour{};
  double opacity = 0.2;     ///< 0 to 1, of each; what lies behind several is covered more
  double outline_px = 1.2;  ///< width of the rims, 0 for none
  std::string label{};      ///< text in the legend, empty for none
};

/// What a colour of the faces means.
struct Swatch {
  Rgb colour{};
  std::string label{};
};

/// What a range of colours of the faces means.
struct ColourScale {
  std::vector<Rgb> colours{};  ///< from the low end to the high one, in equal steps; empty for none
  std::string label{};         ///< what is shown and its range: "depth 3 to 17"
};

/// A line through points, e.g. a path.
struct Polyline {
  std::vector<Vec3> points{};  ///< world, metres; a point that is not finite breaks the line
  Rgb colour{};
  double width_px = 2.0;
  bool dashed = false;
  std::string label{};  ///< text in the legend, empty for none
};

enum class MarkerShape { kDot, kRing, kCross, kDiamond, kSquare, kSquareWithCircle, kSquareWithTriangle };

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

/// Everything that a picture shows, as plain data. Drawn in this order: surfaces, patches, frustum, segments, polylines,
/// markers, labels; within a list, later ones cover earlier ones. Things of one label and one list share a line of the legend.
struct Picture {
  std::string title{};
  std::string subtitle{};  ///< smaller, after the title
  std::vector<Surface> surfaces{};
  std::vector<Swatch> swatches{};  ///< lines of the legend for colours of surfaces
  ColourScale scale{};             ///< the same for a range of colours
  std::vector<Patches> patches{};
  std::vector<FrustumMark> frustums{};  ///< of one robot: its dart stands at the first
  std::vector<Segments> segments{};
  std::vector<Polyline> polylines{};
  std::vector<Markers> markers{};
  std::vector<Label> labels{};
};

}  // namespace hallway::render
