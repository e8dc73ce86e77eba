// SPDX-License-Identifier: MIT
#include "icp/core/options.hpp"

#include <algorithm>

namespace hallway::icp {
namespace {

constexpr OptionRow<Options> kParameters[] = {
    {"max_distance_m", "m", 0.0, 1000.0,
     "Largest distance of a matching point in the end; 0: half the median distance between neighbours, and "
     "three "
     "times that distance with point_to_plane.",
     &Options::max_distance_m},
    {"reach_m", "m", 0.0, 1000.0, "Largest distance of a matching point at first; 0: 4 max_distance_m.",
     &Options::reach_m},
    {"max_points", "points", 10, 10000000,
     "Most points of a frame that are registered; of more, a sample. All of them are a reference for others.",
     &Options::max_points},
    {"max_iterations", "steps", 1, 10000, "Steps after which a registration has failed.",
     &Options::max_iterations},
    {"tolerance", "1", 1e-9, 1.0,
     "A registration has converged where a step moves less than this share of the residual.",
     &Options::tolerance},
    {"normal_neighbours", "points", 3, 1000, "With point_to_plane: how many points a normal is taken from.",
     &Options::normal_neighbours},
    {"min_overlap", "1", 0.0, 1.0, "A frame has a pose where this share of its points has a match.",
     &Options::min_overlap},
    {"keyframe_overlap", "1", 0.0, 1.0,
     "With against = keyframe: the next frame takes over where a smaller share has a match.",
     &Options::keyframe_overlap},
    {"max_turn_rad", "rad", 0.0, 3.15,
     "How far about the sensor's z axis turns are tried when the prediction fails; 0 means none.",
     &Options::max_turn_rad},
    {"min_observations", "observations", 1, 1000000,
     "With against = map: a point with fewer observations is temporary.", &Options::min_observations},
};

}  // namespace

Rules Options::rules_for(double spacing_m) const {
  const double spacings = metric == Metric::point_to_plane ? 3.0 : 0.5;
  const double derived_m = spacing_m > 0.0 ? spacings * spacing_m : 1.0;
  Rules rules;
  rules.metric = metric;
  rules.kernel = kernel;
  rules.max_distance_m = max_distance_m > 0.0 ? max_distance_m : derived_m;
  rules.reach_m = std::max(reach_m > 0.0 ? reach_m : 4.0 * rules.max_distance_m, rules.max_distance_m);
  rules.max_iterations = max_iterations;
  rules.tolerance = tolerance;
  return rules;
}

std::span<const OptionRow<Options>> parameters() {
  return kParameters;
}

}  // namespace hallway::icp
