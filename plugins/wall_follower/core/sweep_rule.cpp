// SPDX-License-Identifier: MIT
#include "wall_follower/core/sweep_rule.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "geometry/median.hpp"
#include "wall_follower/core/angles.hpp"

namespace hallway::wall_follower {

OpeningView view_of(const Sweep& sweep, double into, const Options& options) {
  OpeningView view;
  std::vector<double> ranges;
  for (const Ping& ping : sweep.pings) {
    if (std::abs(wrapped(ping.direction - into)) > radians(options.sweep_window_deg)) continue;
    if (std::isnan(ping.range_m)) continue;
    ++view.pings;
    if (std::isfinite(ping.range_m)) ++view.heard;
    ranges.push_back(ping.range_m);
  }
  view.depth_m = ranges.empty() ? std::numeric_limits<double>::infinity() : median(ranges);
  return view;
}

Opening classify(const OpeningView& view, double wall_m, const Options& options) {
  if (view.depth_m < wall_m + options.cover_m) return Opening::covered;
  return view.depth_m < options.room_depth_m ? Opening::room : Opening::hallway;
}

}  // namespace hallway::wall_follower
