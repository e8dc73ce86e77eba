// SPDX-License-Identifier: MIT
#include "slam_point/core/thesis/options.hpp"

#include <stdexcept>
#include <string>

namespace hallway::slam_point::thesis {
namespace {

constexpr OptionRow<Options> kThesisParameters[] = {
    {"thesis_levels", "1", 1, 3,
     "mode=thesis: 1: temporary groups alone; 2: final groups too; 3: and groups made when a point is out of "
     "view, without "
     "constants.",
     &Options::levels},
    {"thesis_temporary_look_back", "iterations", 2, 1000,
     "mode=thesis: after so many iterations a new point gets a temporary group.",
     &Options::temporary_look_back},
    {"thesis_look_back", "iterations", 2, 1000,
     "mode=thesis: after so many iterations a point gets a final group.", &Options::look_back},
    {"thesis_accuracy_reduction", "iterations", 0, 1000,
     "mode=thesis: how many iterations of the look-back a group's member may miss.",
     &Options::accuracy_reduction},
    {"thesis_previous_min", "points", 3, 1000, "mode=thesis: fewest mapped points in a new group.",
     &Options::previous_min},
    {"thesis_previous_max", "points", 3, 1000, "mode=thesis: most mapped points in a new group.",
     &Options::previous_max},
    {"thesis_next_min", "points", 1, 1000, "mode=thesis: fewest points that a new group maps.",
     &Options::next_min},
    {"thesis_match_iterations", "iterations", 1, 100,
     "mode=thesis: how many iterations back points are matched to as they were seen.",
     &Options::match_iterations},
    {"thesis_merge_after", "iterations", 0, 1000,
     "mode=thesis: after so many iterations a new point is compared with the map and merged; 0: never.",
     &Options::merge_after},
};

void check(const char* name, int value, int min, int max) {
  if (value >= min && value <= max) return;
  throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) + "; it must be between " +
                              std::to_string(min) + " and " + std::to_string(max));
}

}  // namespace

std::span<const OptionRow<Options>> parameters() {
  return kThesisParameters;
}

void Options::validate() const {
  check("thesis_basis", basis, 0, 1);
  check("thesis_matching", matching, 0, 1);
  check_options(*this, parameters());
}

}  // namespace hallway::slam_point::thesis
