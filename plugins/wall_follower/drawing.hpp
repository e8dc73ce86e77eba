// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/plugin.hpp>

#include <cmath>

#include "wall_follower/core/follower.hpp"

namespace hallway::wall_follower {

constexpr double kWallBehind = 0.5, kWallAhead = 1.0;  // of the wall that is shown [m]

/// The name of what the robot does.
inline const char* state_name(State state) {
  static constexpr const char* kNames[] = {"start",    "seek",  "follow", "turn",    "settle",
                                           "advance",  "sweep", "pass",   "reverse", "round",
                                           "back off", "veer",  "cross", "retreat",  "done"};
  return kNames[static_cast<std::size_t>(state)];
}

/// What the robot shows of itself: what its detectors see, the echoes of a sweep that has ended, the line of the wall that it follows, and what it does. Body frame.
inline void draw(const Follower& follower, const Body& body, const Senses& senses, sdk::Drawing& drawing) {
  drawing.clear();
  const auto point = [](const Vec2& at) { return hw_drawing_point_t{at.x(), at.y()}; };
  for (std::size_t look = 0; look < kLooks; ++look) {
    const double range_m = follower.range_m(static_cast<Look>(look));
    if (!std::isfinite(range_m)) continue;
    const Mount& mount = body.infrared[look];
    drawing.add_polyline(HW_COLOUR_SENSED, {point(mount.place), point(mount.point(range_m))});
  }
  if (senses.sweep) {
    for (const Ping& ping : senses.sweep->pings) {
      if (!std::isfinite(ping.range_m)) continue;
      drawing.add_circle(HW_COLOUR_SENSED, ping.range_m * std::cos(ping.direction),
                         ping.range_m * std::sin(ping.direction), 0.05);
    }
  }
  const Wall& wall = follower.wall();
  if (wall.has_points()) {
    const Place& here = follower.odometer().reckoned();
    const double slant = wall.slant(here);
    const Vec2 along(std::cos(slant), -std::sin(slant));
    const Vec2 foot = wall.distance(here.at) * Vec2(-std::sin(slant), -std::cos(slant));
    drawing.add_polyline(HW_COLOUR_FOLLOWED,
                         {point(foot - kWallBehind * along), point(foot + kWallAhead * along)});
  }
  drawing.add_text(follower.state() == State::back_off ? HW_COLOUR_WARNING : HW_COLOUR_PLAIN, 0.3, 0.3,
                   state_name(follower.state()));
}

}  // namespace hallway::wall_follower
