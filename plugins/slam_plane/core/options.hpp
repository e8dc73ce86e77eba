// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>

#include "options/option_table.hpp"
#include "slam_plane/core/types.hpp"

namespace hallway::slam_plane {

/// Standard deviations of what one observation tells of its wall. Lengths in metres.
struct Noise {
  double normal = 0.02;   ///< of the whole observation, across the wall
  double angle = 0.0052;  ///< of the observation's direction, about its middle [rad]
  double end = 0.005;     ///< of each end by itself, along the wall
  double along = 0.0;     ///< of the whole observation, along the wall

  /// Variance of the place of an end, along the wall [m^2].
  double end_variance() const { return end * end + along * along; }
};

/// Every tunable. The noise is what is to be chosen.
struct Options {
  double noise_m = 0.02;           ///< Noise::normal
  double noise_angle_deg = 0.3;    ///< Noise::angle, in degrees
  double noise_end_m = 0.005;      ///< Noise::end
  double noise_along_m = 0.0;      ///< Noise::along
  double match_bound_m = 0.15;     ///< farthest an observation may lie from a wall seen just before [m]
  double map_bound_m = 0.2;        ///< the same of a wall seen earlier [m]
  double match_angle_deg = 5.0;    ///< largest angle between an observation and its wall
  double corner_sigmas = 4.0;      ///< an end this near to the border of what can be seen is a cut
  double border_margin_deg = 3.0;  ///< and what is added to that at the sides of the view
  int corner_sightings = 5;        ///< that make an end certain
  double undetermined_m =
      0.1;               ///< standard deviation of a position above which its direction is unobservable
  double overlap = 0.8;  ///< a submap closes when what is seen overlaps its first frame less
  int max_submap_frames = 100;  ///< and after this many frames
  int min_observations = 5;     ///< of a wall that is mapped
  double smoothing = 0.3;       ///< share of the newest motion in the predicted one
  /// Noise::normal is at least this [m]: a map that grows is never as exact as a sensor may be. No parameter.
  double least_noise_m = 0.0;

  Noise noise() const {
    return {std::max(noise_m, least_noise_m), radians(noise_angle_deg), noise_end_m, noise_along_m};
  }

  /// Throws std::invalid_argument that names the parameter, its value and its range.
  void validate() const;
};

/// All parameters, in the order of Options.
std::span<const OptionRow<Options>> parameters();

}  // namespace hallway::slam_plane
