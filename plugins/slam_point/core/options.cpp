// SPDX-License-Identifier: MIT
#include "slam_point/core/options.hpp"

#include <iterator>
#include <stdexcept>
#include <string>

#include "slam_point/core/index/point_index.hpp"

namespace hallway::slam_point {
namespace {

constexpr OptionRow<Options> kParameters[] = {
    {"noise_m", "m", 1e-4, 10.0,
     "Standard deviation of one coordinate of an observation; bounds that are 0 derive from it.",
     &Options::noise_m},
    {"noise_per_m", "1", 0.0, 1.0,
     "Noise that grows with the range, in metres per metre; added in quadrature. Farther points then count "
     "for less.",
     &Options::noise_per_m},
    {"noise_per_m2", "1/m", 0.0, 1.0,
     "Noise that grows with the square of the range, as of stereo; added in quadrature.",
     &Options::noise_per_m2},
    {"noise_across_m", "m", 0.0, 10.0,
     "Noise across the ray to a point, where it differs from that along it; the noises above are then along "
     "the ray. 0 with noise_across_per_m 0: the same in all directions.",
     &Options::noise_across_m},
    {"noise_across_per_m", "1", 0.0, 1.0,
     "What the noise across the ray grows by with the range, as of bearings [rad]; added in quadrature.",
     &Options::noise_across_per_m},
    {"match_bound_m", "m", 0.0, 100.0,
     "Farthest a point may lie from where the motion prediction puts it; 0 means 12 noise_m.",
     &Options::match_bound_m},
    {"map_bound_m", "m", 0.0, 100.0,
     "The same against what was mapped earlier, as when a loop closes; 0 means 16 noise_m.",
     &Options::map_bound_m},
    {"separation_m", "m", 0.0, 100.0,
     "Nothing becomes a new landmark closer than this to another; 0 means 5 noise_m.",
     &Options::separation_m},
    {"overlap", "1", 0.05, 0.99,
     "A submap closes when the landmarks in view and those of its first frame overlap (Jaccard) less than "
     "this.",
     &Options::overlap},
    {"max_submap_frames", "frames", 2, 100000,
     "A submap closes, and may be taken up again, after so many frames.", &Options::max_submap_frames},
    {"window", "submaps", 1, 200, "How many of the last submaps are placed together at each close.",
     &Options::window},
    {"global_period", "closes", 0, 100000,
     "Closes between steps over the whole map once a loop has closed, but at least a tenth of the submaps; "
     "0: none.",
     &Options::global_period},
    {"sweeps", "sweeps", 0, 20, "How often a submap's own frames are aligned again at its close.",
     &Options::sweeps},
    {"min_observations", "observations", 1, 1000000,
     "A landmark with fewer observations is temporary: it may be clutter.", &Options::min_observations},
    {"find_moving", "1", 0, 1,
     "1: landmarks that move are found and kept out of the map; 0: all landmarks are taken to stand.",
     &Options::find_moving},
    {"smoothing", "1", 0.01, 1.0, "Share of the newest relative motion in the motion prediction.",
     &Options::smoothing},
    {"max_turn_rad", "rad", 0.0, 3.15,
     "How far about the sensor's z axis a turn is searched when the prediction fails; 0 means no search.",
     &Options::max_turn_rad},
    {"bridge_frames", "frames", 0, 100000,
     "How many frames without a pose the last motion is continued for; after them a new part of the map "
     "begins.",
     &Options::bridge_frames},
    {"report_parts", "1", 0, 1,
     "1: poses and map are those of the part of the map that the sensor is in; 0: only those of the "
     "part that the map began with.",
     &Options::report_parts},
};

}  // namespace

std::span<const OptionRow<Options>> parameters() {
  return kParameters;
}

void Options::validate() const {
  if (index < 0 || index >= static_cast<int>(std::size(kIndexNames)))
    throw std::invalid_argument("index is " + std::to_string(index) + "; there is no such structure");
  check_options(*this, parameters());
}

}  // namespace hallway::slam_point
