// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "icp/core/registration.hpp"

namespace hallway::icp {

/// How two clouds are aligned; what is not given follows from the clouds.
struct AlignOptions {
  Metric metric = Metric::point_to_plane;
  Kernel kernel = Kernel::tukey;
  std::optional<double>
      cube_m{};  ///< edge of the cubes that points are thinned by [m]; 0: not at all; else a hundredth of extent_of(a)
  std::optional<double>
      max_distance_m{};  ///< farthest match in the end [m], above 0; else three times the spacing of `a`, thinned
  std::optional<double>
      reach_m{};  ///< farthest match at first [m], above 0; else a fifth of extent_of(a), at least max_distance_m
  int max_iterations = 200;    ///< steps of the registration
  int normal_neighbours = 20;  ///< points that a normal is taken from
};

/// An alignment, and what it was made with.
struct Alignment {
  Registration registration{};  ///< T_a_b
  double cube_m = 0.0;          ///< 0: not thinned
  Rules rules{};
  std::size_t used_a = 0;  ///< points after thinning
  std::size_t used_b = 0;
};

/// Registers cloud `b` with cloud `a` from a guess at T_a_b. The order of points changes nothing but rounding. O(n log n) a step.
Alignment align(const Points& a, const Points& b, const Pose& guess, const AlignOptions& options);

}  // namespace hallway::icp
