// SPDX-License-Identifier: MIT
#include "wall_follower/core/options.hpp"

namespace hallway::wall_follower {
namespace {

constexpr OptionRow<Options> kParameters[] = {
    {"speed_m_s", "m/s", 0.01, 2.0, "Speed along a wall.", &Options::speed_m_s},
    {"turn_rad_s", "rad/s", 0.1, 10.0, "Rate of a turn on the spot, of the tracks.", &Options::turn_rad_s},
    {"distance_m", "m", 0.2, 2.0, "Distance of the robot's middle from the wall that it follows.",
     &Options::distance_m},
    {"front_m", "m", 0.1, 2.0, "A wall nearer than this to the detector in front ends the way.",
     &Options::front_m},
    {"gone_m", "m", 0.1, 10.0, "A wall farther than this from the detector to the right is none.",
     &Options::gone_m},
    {"least_step_m", "m", 0.02, 1.0, "Least discontinuity of a wall.", &Options::least_step_m},
    {"confirm_m", "m", 0.01, 1.0, "Way behind a discontinuity after which it is certain.",
     &Options::confirm_m},
    {"edge_m", "m", 0.01, 1.0, "Way without a wall after which it has ended.", &Options::edge_m},
    {"fit_m", "m", 0.1, 2.0, "Way whose points make the line of the wall.", &Options::fit_m},
    {"longest_pass_m", "m", 0.5, 10.0, "An opening longer than this is no doorway.",
     &Options::longest_pass_m},
    {"turn_slip", "1", 0.0, 0.6, "Share of a turn that the tracks lose, before walls have taught it.",
     &Options::turn_slip},
    {"cover_m", "m", 0.0, 2.0,
     "An echo nearer than this behind the line of the wall is of something dark, and no opening.",
     &Options::cover_m},
    {"room_depth_m", "m", 0.5, 20.0,
     "An opening whose free space reaches beyond this is a hallway; another one is a room if the wall goes "
     "on "
     "within longest_pass_m.",
     &Options::room_depth_m},
    {"sweep_window_deg", "deg", 1.0, 60.0, "Pings within this of the direction into the opening count.",
     &Options::sweep_window_deg},
    {"bump_back_m", "m", 0.02, 0.5, "Way back after a bump.", &Options::bump_back_m},
    {"match_score", "1", 1.0, 100.0, "Score of the landmarks that close a loop.", &Options::match_score},
    {"match_margin", "1", 0.0, 100.0,
     "The loop is uncertain where another place has a score that is less than this below the best.",
     &Options::match_margin},
    {"least_lap_m", "m", 0.5, 1000.0, "Shortest loop.", &Options::least_lap_m},
    {"drift_m", "m", 0.05, 10.0, "How far the reckoned way of a lap may be from leading back.",
     &Options::drift_m},
    {"drift_per_m", "1", 0.0, 1.0, "What this grows by for each metre of the lap.", &Options::drift_per_m},
    {"exploration", "1", 0, 2,
     "Which opening is next after a loop: 0 none, and the robot stands; 1 the next one along the wall on its "
     "right; 2 the one with the least way there and across.",
     &Options::exploration},
    {"most_nodes", "nodes", 8, 4000, "Nodes of a chart; with more the robot stops.", &Options::most_nodes},
};

}  // namespace

std::span<const OptionRow<Options>> parameters() {
  return kParameters;
}

}  // namespace hallway::wall_follower
