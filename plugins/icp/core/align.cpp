// SPDX-License-Identifier: MIT
#include "icp/core/align.hpp"

#include <algorithm>

#include "icp/core/cloud_scale.hpp"

namespace hallway::icp {
namespace {

constexpr double kCubesPerExtent = 100.0;
constexpr double kReachesPerExtent = 5.0;
constexpr double kSpacings = 3.0;

Points usable_and_thinned(const Points& points, double cube_m) {
  const Points usable = usable_points(points);
  return cube_m > 0.0 ? thinned(usable, cube_m) : usable;
}

}  // namespace

Alignment align(const Points& a, const Points& b, const Pose& guess, const AlignOptions& options) {
  const double extent_m = extent_of(usable_points(a));
  Alignment result;
  result.cube_m = options.cube_m.value_or(extent_m / kCubesPerExtent);
  const bool planes = options.metric == Metric::point_to_plane;
  const Target target(usable_and_thinned(a, result.cube_m),
                      planes ? static_cast<std::size_t>(options.normal_neighbours) : 0);
  const Points source = usable_and_thinned(b, result.cube_m);
  result.used_a = target.points().size();
  result.used_b = source.size();

  Rules& rules = result.rules;
  rules.metric = options.metric;
  rules.kernel = options.kernel;
  rules.max_iterations = options.max_iterations;
  const double spacing_m = spacing_of(target.points(), target.tree());
  rules.max_distance_m = options.max_distance_m.value_or(spacing_m > 0.0 ? kSpacings * spacing_m : 1.0);
  rules.reach_m = std::max(options.reach_m.value_or(extent_m / kReachesPerExtent), rules.max_distance_m);
  result.registration = register_cloud(target, source, guess, rules);
  return result;
}

}  // namespace hallway::icp
