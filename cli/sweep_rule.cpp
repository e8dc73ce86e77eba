// SPDX-License-Identifier: MIT
#include "sweep_rule.hpp"

#include "wall_follower/core/sweep_rule.hpp"

namespace hallway::cli {

study::SweepRule wall_follower_rule() {
  return [](const study::LabelledSweep& heard, const study::SweepRuleParameters& parameters) {
    wall_follower::Options options;
    options.cover_m = parameters.cover_m;
    options.room_depth_m = parameters.room_depth_m;
    options.sweep_window_deg = parameters.window_deg;
    wall_follower::Sweep sweep;
    sweep.pings.reserve(heard.pings.size());
    for (const study::HeardPing& ping : heard.pings)
      sweep.pings.push_back({ping.direction_rad, ping.range_m});
    const wall_follower::OpeningView view = wall_follower::view_of(sweep, heard.into_rad(), options);
    switch (wall_follower::classify(view, heard.opening.wall_m, options)) {
      case wall_follower::Opening::covered:
        return study::OpeningKind::kCovered;
      case wall_follower::Opening::room:
        return study::OpeningKind::kRoom;
      case wall_follower::Opening::hallway:
        break;
    }
    return study::OpeningKind::kHallway;
  };
}

study::SweepRuleParameters wall_follower_parameters() {
  const wall_follower::Options options;
  return {.cover_m = options.cover_m,
          .room_depth_m = options.room_depth_m,
          .window_deg = options.sweep_window_deg};
}

double wall_follower_longest_pass_m() {
  return wall_follower::Options().longest_pass_m;
}

}  // namespace hallway::cli
