// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "planes/plane.hpp"

namespace hallway::planes {

/// A closed range of numbers.
template <typename T>
struct Range {
  T low{};
  T high{};
};

/// What scenes are like. Where a range is given, each scene has a number of its own from it.
struct SceneOptions {
  Range<std::uint32_t> planes{3, 40};        ///< number of planes, at least 1
  Range<std::uint32_t> points{300, 30'000};  ///< number of points, evenly by its logarithm; there are as
      ///< many planes as leave each 100 on average, at least the fewest
  Range<double> noise{0.005, 0.05};   ///< standard deviation along each axis, evenly by its logarithm, m
  Range<double> half_size{0.5, 2.0};  ///< half sides of a rectangle, m
  double outliers = 0.1;              ///< most outliers, as a share of the points; every other scene has none
  double box = 10.0;                  ///< side of the cube that holds all planes, from the origin on, m
};

/// A rectangle of a scene.
struct SceneRectangle {
  std::int64_t label = 0;
  Vec3 centre = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit
  Vec3 u = Vec3::UnitX();       ///< unit, in the rectangle
  double half_u = 1.0;          ///< along u
  double half_v = 1.0;          ///< along normal x u
  std::uint32_t points = 0;     ///< that lie on it
  double noise = 0.0;           ///< of them
};

/// Points on finite planes, and what is true of them.
struct Scene {
  std::vector<Vec3> points{};
  std::vector<std::int64_t> labels{};  ///< for each point; kNoLabel: an outlier
  std::vector<SceneRectangle> rectangles{};
};

/// Makes scene `index` of a seed: a pure function of its arguments. Random rectangles, some of which cross. For each twelve planes, and in every scene of four or
/// more, two are a parallel pair of the same outline, one before the other at 4 to 28 sigma, and two an attached one: the second stands upright on the first, at an edge
/// of it or within it. One plane in four has a round hole, as if something hid a part of it. The points of each are even over its area, their number differs from plane to plane by up to
/// ten times; order is random.
/// Throws Error{kUsage} for options that no scene fits.
Scene make_scene(std::uint64_t seed, std::uint32_t index, const SceneOptions& options);

/// What a score needs to know of a scene.
Truth truth_of(const Scene& scene);

/// The rectangle's corners, counter-clockwise about its normal.
Corners corners_of(const SceneRectangle& rectangle);

}  // namespace hallway::planes
