// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "slam_point/core/fit/directional_fit.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point {

/// A usable point of the current frame and its association.
struct Observation {
  Vec3 point = Vec3::Zero();  ///< sensor frame [m]
  std::size_t given = 0;      ///< its place among the points given
  Index landmark = kNone;
  Index member = kNone;   ///< of the active submap, where it was matched to one of its members
  bool withheld = false;  ///< neither a known landmark nor a new one: this frame cannot decide
  /// Where `landmark` is kNone: the landmark that it follows, which moves or has left its place.
  Index moving = kNone;
  /// (noise_m / noise at its range)^2: its weight beside a point without range noise.
  double weight = 1.0;
  double across = 1.0;       ///< the same of the noise across its ray, where noise has directions
  TrackId track = kNoTrack;  ///< under which the sensor follows it; kNoTrack: it is associated by its place
  Index expected = kNone;    ///< the landmark of its track; kNone for a new track

  RayWeight weights() const { return {weight, across}; }
  bool is_followed() const { return track != kNoTrack; }
};

using Observations = std::vector<Observation>;

/// One frame: the value that a placement is found for.
struct Frame {
  Observations observations{};
  bool planar = true;     ///< all points are in the plane z = 0, those of the frames before too
  bool followed = false;  ///< it came with the sensor's tracks, and they count
};

}  // namespace hallway::slam_point
