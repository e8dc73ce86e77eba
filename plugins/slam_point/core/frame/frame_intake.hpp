// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "slam_point/core/frame/frame.hpp"
#include "slam_point/core/frame/track_book.hpp"
#include "slam_point/core/options.hpp"

namespace hallway::slam_point {

/// Makes observations of the points given: which are usable, what each counts for, and which landmark its track has.
class FrameIntake {
 public:
  /// `book` and `graph` must outlive it.
  FrameIntake(const Options& options, const TrackBook& book, const SubmapGraph& graph);

  /// Makes `frame`, which is the one before, the frame of the usable points, in their order. `tracks`: see Mapper::process.
  void take(std::span<const Vec3> points, std::span<const TrackId> tracks, Frame& frame) const;

  /// Whether a point can be used: it is finite and not beyond 1e6 m.
  static bool is_usable(const Vec3& point);

 private:
  void weigh(Observation& observation) const;
  Index expected(TrackId track) const;

  Options options_;
  const TrackBook& book_;
  const SubmapGraph& graph_;
  bool ranges_count_;  // noise differs by range or direction
};

}  // namespace hallway::slam_point
