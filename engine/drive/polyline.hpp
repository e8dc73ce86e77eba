// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::drive {

/// A place on a polyline.
struct Nearest {
  double along_m = 0.0;     ///< from its begin
  double distance_m = 0.0;  ///< of the point that was asked for, in the plane
};

/// A line through points of the plane z = 0, by its arc length. A closed one has no end: its arc length goes on round after round.
class Polyline {
 public:
  /// Of each point, x and y count. Points that repeat the one before are skipped. Throws Error{kBadInput} if one is not finite, or if fewer than two are
  /// left.
  Polyline(const std::vector<Vec3>& points, bool closed);

  /// Of one round if it is closed [m].
  double length_m() const { return along_.back(); }
  bool is_closed() const { return closed_; }

  /// The point at an arc length >= 0. Beyond the end of an open line it is on its last segment's direction.
  Vec2 at(double along_m) const;
  /// The nearest point between two arc lengths, from <= to; the first of those that are equally near. Cost: the segments between them.
  Nearest nearest(const Vec2& point, double from_m, double to_m) const;

 private:
  std::size_t segment_at(double along_m) const;

  bool closed_;
  std::vector<Vec2> points_;
  std::vector<double> along_;  // of each point
};

}  // namespace hallway::drive
