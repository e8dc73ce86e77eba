// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <initializer_list>
#include <vector>

#include "slam_plane/thesis/comparison.hpp"
#include "slam_plane/thesis/plane_track.hpp"

namespace hallway::slam_plane::thesis::test {

/// A length that is none but for rounding [m].
inline constexpr double kExact = 1e-9;

/// Walls of a small world, m. They are told apart by where they stand: `kAlong` runs along x, left of a robot that drives along x, so that in its frame it needs no turning.
inline const Segment kAlong{{Vec2(-2, 2), Vec2(6, 2)}};
inline const Segment kAhead{{Vec2(12, 3), Vec2(12, -3)}};
inline const Segment kSlanted{{Vec2(8, 4), Vec2(11, 2)}};
inline const Segment kFacing{{Vec2(6, -2), Vec2(-2, -2)}};  // across the corridor from kAlong

/// Driving along x without turning.
inline Pose2 straight(Iteration k) {
  return Pose2::at(Vec2(0.02 * static_cast<double>(k), 0.0), 0.0);
}

/// Driving in a curve.
inline Pose2 curved(Iteration k) {
  const auto t = static_cast<double>(k);
  return Pose2::at(Vec2(0.02 * t, 0.3 * std::sin(0.05 * t)), 0.4 * std::sin(0.07 * t));
}

/// The part of a wall from `left` metres beside its left end to `right` metres beside its right one, as a robot sees it.
inline TimedObservation seen(const Segment& wall, const Pose2& T_world_robot, Iteration k, double left = 0.0,
                             double right = 0.0) {
  const Vec2 d = wall.direction();
  const Segment part = T_world_robot.inverse() * Segment{{wall.end[0] + left * d, wall.end[1] - right * d}};
  return make_observation({part.end[0], part.end[1], 0.0, 2.5}, k).value();
}

/// What of a wall is hidden at an iteration, beside its left and beside its right end [m].
struct Hidden {
  double left = 0.0, right = 0.0;
};

/// A track that saw a wall in all iterations of an interval, each time but for what `hidden(k)` says.
template <typename Path, typename Hide>
PlaneTrack track_of(TrackId id, const Segment& wall, const Interval& interval, const Path& path,
                    const Hide& hidden) {
  PlaneTrack track(id, TrackOptions{});
  for (Iteration k = interval.first; k <= interval.last; ++k) {
    const Hidden h = hidden(k);
    track.push(seen(wall, path(k), k, h.left, h.right));
  }
  return track;
}

template <typename Path>
PlaneTrack track_of(TrackId id, const Segment& wall, const Interval& interval, const Path& path) {
  return track_of(id, wall, interval, path, [](Iteration) { return Hidden{}; });
}

/// Where in the frame of `wall` (its middle, along x) a point of the world lies.
inline Vec2 in_frame_of(const Segment& wall, const Vec2& p) {
  return Pose2{wall.middle(), wall.direction()}.inverse() * p;
}

/// How far a comparison of two walls is from the truth: of the vector from a's key point to b's, and of b's direction [m, 1].
inline double error_of(const Comparison& comparison, const Segment& a, const Segment& b) {
  const int ka = comparison.key[0] == KeyPoint::left ? kEndA : kEndB;
  const int kb = comparison.key[1] == KeyPoint::left ? kEndA : kEndB;
  const Segment in_a = comparison.placement(0).segment(), in_b = comparison.placement(1).segment();
  const Vec2 truth = in_frame_of(a, b.end[kb]) - in_frame_of(a, a.end[ka]);
  const Vec2 direction = in_frame_of(a, a.middle() + b.direction());
  return std::max((in_b.end[kb] - in_a.end[ka] - truth).norm(), (comparison.direction - direction).norm());
}

/// How far a placement in the frame of `base` is from `wall` at its full size [m].
inline double error_of(const Placement& placement, const Segment& base, const Segment& wall) {
  const Segment segment = placement.segment();
  return std::max((segment.end[0] - in_frame_of(base, wall.end[0])).norm(),
                  (segment.end[1] - in_frame_of(base, wall.end[1])).norm());
}

}  // namespace hallway::slam_plane::thesis::test
