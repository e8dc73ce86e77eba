// SPDX-License-Identifier: MIT
#pragma once

#include "study/first_robot/sweep_calibration.hpp"

namespace hallway::cli {

/// How wall_follower distinguishes a room from a hallway, for the study `sonar-rooms`.
study::SweepRule wall_follower_rule();

/// The parameters that the plugin has where none are set.
study::SweepRuleParameters wall_follower_parameters();

/// What the plugin passes as a doorway, at most, where nothing else is set [m].
double wall_follower_longest_pass_m();

}  // namespace hallway::cli
