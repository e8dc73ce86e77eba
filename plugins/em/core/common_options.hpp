// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "em/core/cloud_scale.hpp"
#include "options/option_table.hpp"

namespace hallway::em {

/// What `em1` and `em2` are both told. Lengths that are 0 derive from the cloud (lengths_of()).
struct CommonOptions {
  double distance =
      0.0;  ///< farthest a point lies from a plane that it belongs to; 0: 3.5 x the noise measured
  double expansion =
      0.0;  ///< how far beyond its bounds a plane looks for points; 0: 4 x the spacing measured
  double seed_distance =
      0.0;  ///< farthest the two points lie that make a plane of a random one; 0: 4 x the spacing
  double merge_angle_deg = 10.0;  ///< largest angle between planes that are merged
  double merge_offset = 0.0;      ///< largest distance between planes that are merged; 0: as `distance`
  int share_points = 1;           ///< 1: a point may belong to several planes
  int min_points = 12;            ///< a plane with fewer is dropped
  double min_exclusive = 0.2;     ///< a plane with a smaller share of points of its own is dropped
  double max_unmatched = 0.002;   ///< done when no larger share of the points is left
  int seed = 1;                   ///< of the random choices
};

/// The lengths in use, in the cloud's unit.
struct Lengths {
  double distance = 0.0;
  double expansion = 0.0;
  double seed_distance = 0.0;
  double merge_offset = 0.0;
};

/// The lengths of the options, those that are 0 filled in from the cloud. Where the noise is larger than the spacing, planes are
/// sought within twice `distance`, so that a new plane becomes wider than it is thick.
Lengths lengths_of(const CommonOptions& options, const CloudScale& scale);

/// The rows of CommonOptions in the table of an algorithm whose options derive from it.
template <typename Options>
constexpr std::array<OptionRow<Options>, 10> common_rows() {
  return {{
      {"distance", "length", 0.0, 1e9,
       "Farthest a point may lie from a plane that it belongs to; 0: 3.5 times the noise of the cloud.",
       &Options::distance},
      {"expansion", "length", 0.0, 1e9,
       "How far beyond its bounds a plane looks for points; 0: 4 times the spacing of the points, and at "
       "least twice "
       "distance.",
       &Options::expansion},
      {"seed_distance", "length", 0.0, 1e9,
       "Farthest the two points may lie that make a plane together with a random one; 0: 4 times the "
       "spacing.",
       &Options::seed_distance},
      {"merge_angle_deg", "deg", 0.0, 90.0, "Largest angle between planes that are merged.",
       &Options::merge_angle_deg},
      {"merge_offset", "length", 0.0, 1e9, "Largest distance between planes that are merged; 0: as distance.",
       &Options::merge_offset},
      {"share_points", "1", 0, 1, "1: a point may belong to several planes; 0: to one only.",
       &Options::share_points},
      {"min_points", "points", 3, 1000000, "A plane with fewer points is dropped.", &Options::min_points},
      {"min_exclusive", "1", 0.0, 1.0,
       "A plane is dropped if a smaller share of its points is its own; 0: no check.",
       &Options::min_exclusive},
      {"max_unmatched", "1", 0.0, 1.0,
       "The search ends when no larger share of the points is left without a plane.",
       &Options::max_unmatched},
      {"seed", "1", 0, 2147483647, "Seed of the random choices.", &Options::seed},
  }};
}

}  // namespace hallway::em
