// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "icp/core/registration.hpp"
#include "options/option_table.hpp"

namespace hallway::icp {

/// What a frame is registered with.
enum class Against {
  previous,  ///< the last frame that had a pose
  keyframe,  ///< a frame that stays until too little of it is in view
  map        ///< the points of all frames that had a pose
};

/// Every tunable of the localiser.
struct Options {
  Against against = Against::previous;
  Metric metric = Metric::point_to_point;
  Kernel kernel = Kernel::tukey;
  double max_distance_m = 0.0;    ///< farthest match in the end [m]; 0: half the spacing (thrice with planes)
  double reach_m = 0.0;           ///< farthest match at first [m]; 0: 4 max_distance_m
  int max_points = 2000;          ///< most points of a frame that are registered; of more, a sample
  int max_iterations = 100;       ///< steps of one registration
  double tolerance = 1e-3;        ///< settled below this share of the residual [1]
  int normal_neighbours = 10;     ///< points that a normal is taken from
  double min_overlap = 0.5;       ///< a pose needs this share of points with a match [1]
  double keyframe_overlap = 0.7;  ///< a keyframe is replaced below this share [1]
  double max_turn_rad = 0.35;     ///< how far turns are tried when the prediction fails [rad]; 0: none
  int min_observations = 5;       ///< observations from which on a point of the map is `mapped`

  /// How a frame is registered with a cloud of this spacing [m]. Throws nothing; distances that would be 0 are 1 m.
  Rules rules_for(double spacing_m) const;
};

/// The numbers among Options, in their order. Defaults are those of a default-made Options.
std::span<const OptionRow<Options>> parameters();

}  // namespace hallway::icp
