// SPDX-License-Identifier: MIT
#include "slam_plane/core/options.hpp"

namespace hallway::slam_plane {
namespace {

constexpr OptionRow<Options> kParameters[] = {
    {"noise_m", "m", 1e-4, 1.0, "Standard deviation of a plane observation across its wall.",
     &Options::noise_m},
    {"noise_angle_deg", "deg", 1e-3, 10.0,
     "Standard deviation of a plane observation's direction, about its middle.", &Options::noise_angle_deg},
    {"noise_end_m", "m", 1e-4, 1.0,
     "Standard deviation of each end of a plane observation by itself, along its wall.",
     &Options::noise_end_m},
    {"noise_along_m", "m", 0.0, 1.0, "Standard deviation of a whole plane observation along its wall.",
     &Options::noise_along_m},
    {"match_bound_m", "m", 1e-3, 10.0,
     "Largest distance of a plane observation from a wall seen in the last frames.", &Options::match_bound_m},
    {"map_bound_m", "m", 1e-3, 10.0, "Largest distance of a plane observation from a wall seen earlier.",
     &Options::map_bound_m},
    {"match_angle_deg", "deg", 0.1, 45.0, "Largest angle between a plane observation and its wall.",
     &Options::match_angle_deg},
    {"corner_sigmas", "1", 1.0, 20.0,
     "An end within so many standard deviations of the border of the visible area is a cut, not a corner.",
     &Options::corner_sigmas},
    {"border_margin_deg", "deg", 0.0, 20.0, "Added to that at the sides of the view.",
     &Options::border_margin_deg},
    {"corner_sightings", "observations", 1, 1000, "Observations that make an end a certain corner.",
     &Options::corner_sightings},
    {"undetermined_m", "m", 1e-3, 10.0,
     "Standard deviation of the position above which a direction counts as undetermined.",
     &Options::undetermined_m},
    {"overlap", "1", 0.05, 0.99,
     "A submap closes when the walls in view and those of its first frame overlap (Jaccard) less than this.",
     &Options::overlap},
    {"max_submap_frames", "frames", 2, 100000,
     "A submap closes, and may become active again, after so many frames.", &Options::max_submap_frames},
    {"min_observations", "observations", 1, 1000000,
     "A wall with fewer observations is temporary: it may be clutter.", &Options::min_observations},
    {"smoothing", "1", 0.01, 1.0, "Share of the newest relative motion in the motion prediction.",
     &Options::smoothing},
};

}  // namespace

std::span<const OptionRow<Options>> parameters() {
  return kParameters;
}

void Options::validate() const {
  check_options(*this, parameters());
}

}  // namespace hallway::slam_plane
