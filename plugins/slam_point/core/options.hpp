// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "options/option_table.hpp"

namespace hallway::slam_point {

/// What tells which landmark a point is.
enum class Association : int {
  place,  ///< where it lies
  sensor  ///< the track under which the sensor follows it; where it has none, its place
};

/// Every tunable. `noise_m` is the one to choose; the bounds follow from it where they are 0.
struct Options {
  double noise_m = 0.05;      ///< standard deviation of one coordinate of an observation [m]
  double noise_per_m = 0.0;   ///< what is added to the noise per metre of range [1]; see noise_at()
  double noise_per_m2 = 0.0;  ///< what is added to the noise per square metre of range [1/m]; see noise_at()
  double noise_across_m = 0.0;  ///< standard deviation across the ray [m]; see noise_across_at()
  double noise_across_per_m =
      0.0;  ///< what is added to it per metre of range [1]: of bearings; see noise_across_at()
  double match_bound_m =
      0.0;  ///< farthest a point may lie from where the prediction puts it [m]; 0: 12 noise_m
  double map_bound_m =
      0.0;  ///< the same against everything mapped earlier, after the pose fit [m]; 0: 16 noise_m
  double separation_m =
      0.0;               ///< closer than this to a landmark nothing becomes a new landmark [m]; 0: 5 noise_m
  double overlap = 0.8;  ///< a submap closes when what is seen overlaps its first frame less [1]
  int max_submap_frames = 200;  ///< a submap is closed, and may be re-opened, after this many frames
  int window = 20;              ///< submaps re-placed together at each close
  int global_period = 3;  ///< closes between steps over the whole map once a loop has closed; 0: never online
  int sweeps = 2;         ///< re-alignments of a submap's own frames at its close
  int min_observations = 5;  ///< observations that make a landmark `mapped`
  int find_moving =
      1;  ///< 1: landmarks that move are found and kept out of the map; 0: all are taken to stand
  double smoothing = 0.5;  ///< share of the newest relative motion in the prediction [1]
  double max_turn_rad =
      0.35;       ///< how far from the prediction a turn is searched when it fails [rad]; 0: no search
  int index = 0;  ///< an IndexKind: what finds points near a place

  int bridge_frames =
      10;  ///< frames without a pose that the last motion is continued for; then a new part begins
  int report_parts = 0;  ///< 1: pose and map are told of whatever part the sensor is in; 0: of the first only
  Association association = Association::place;
  /// Bounds derive from a noise of at least this [m]: a prediction is never as good as a sensor may be. No parameter.
  double least_bound_noise_m = 0.0;

  /// Standard deviation of one coordinate of an observation at a range [m]: independent parts that are constant, grow with
  /// the range, and grow with its square (stereo, whose disparity is equally exact everywhere).
  double noise_at(double range_m) const {
    return std::hypot(noise_m, noise_per_m * range_m, noise_per_m2 * range_m * range_m);
  }

  /// Whether the noise along the ray from the sensor to a point and that across it are told apart.
  bool is_directional() const { return noise_across_m > 0.0 || noise_across_per_m > 0.0; }
  /// Standard deviation of an observation at a range, in each direction across its ray [m]: two independent parts. noise_at() is then along
  /// the ray. Where both parameters are 0, the noise is the same in all directions.
  double noise_across_at(double range_m) const {
    if (!is_directional()) return noise_at(range_m);
    constexpr double kLeastShare = 0.01;  // of noise_m: nothing is exact
    return std::max(std::hypot(noise_across_m, noise_across_per_m * range_m), kLeastShare * noise_m);
  }

  /// Throws std::invalid_argument that names the parameter, its value and its range.
  void validate() const;

  /// The three bounds with their derived values filled in [m].
  double match_bound() const { return match_bound_m > 0.0 ? match_bound_m : 12.0 * bound_noise(); }
  double map_bound() const { return map_bound_m > 0.0 ? map_bound_m : 16.0 * bound_noise(); }
  double separation() const { return separation_m > 0.0 ? separation_m : 5.0 * bound_noise(); }
  /// A residual up to here is noise, for a point of weight 1 [m]: a correct match is farther off once in 10^7.
  double agreement() const { return 6.0 * noise_m; }
  double bound_noise() const { return std::max(noise_m, least_bound_noise_m); }
};

/// All parameters, in the order of Options. Defaults are those of a default-made Options.
std::span<const OptionRow<Options>> parameters();

}  // namespace hallway::slam_point
