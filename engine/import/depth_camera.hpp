// SPDX-License-Identifier: MIT
#pragma once

#include "image/png.hpp"
#include "import/point_collector.hpp"

namespace hallway::import {

/// A camera without distortion: pixel (u, v) of the optical frame's point (x right, y down, z forward) is fx x / z + cx, fy y / z + cy. The centre of the
/// first pixel is (0, 0).
struct Camera {
  double fx_px = 525.0;
  double fy_px = 525.0;
  double cx_px = 319.5;
  double cy_px = 239.5;
};

/// Metres of depth are this many units of a depth image of the TUM RGB-D benchmark.
inline constexpr double kDepthUnitsPerMetre = 5000.0;

/// T_optical_body: the body of a recording from a camera looks along x (x forward, y left, z up), the camera's optical frame along z.
Pose optical_from_body();

/// The points that a depth image shows, in the frame of the body (x forward, y left, z up), row by row: of each `stride`-th pixel of each `stride`-th
/// row, from the first of each, those whose depth is not 0.
/// They are pixels of the image of the pixels that are looked at.
/// @param units_per_metre  of the image's values
void add_depth_points(const Gray16& image, const Camera& camera, std::uint32_t stride, PointCollector& out,
                      double units_per_metre = kDepthUnitsPerMetre);

}  // namespace hallway::import
