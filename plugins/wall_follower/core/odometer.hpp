// SPDX-License-Identifier: MIT
#pragma once

#include "wall_follower/core/angles.hpp"

namespace hallway::wall_follower {

/// A position and a heading in a plane.
struct Place {
  Vec2 at = Vec2::Zero();  ///< [m]
  double heading = 0.0;    ///< not wrapped: a whole turn to the left adds 2 pi [rad]

  /// A point of the body frame in the frame of the place, and back.
  Vec2 out(const Vec2& body) const { return at + turned(body, heading); }
  Vec2 in(const Vec2& point) const { return turned(point - at, -heading); }
};

/// Reckons by the encoders (thesis 2.2.4). Straight ways are accurate. Turns are not, since tracks slip in them: so a turn is taken as a multiple of
/// 90 degrees, and the heading is aligned again on the next wall, which is taken as parallel to one of two axes.
class Odometer {
 public:
  /// @param turn_slip  share of a turn of the tracks that the body does not make, at first
  explicit Odometer(double wheel_base_m = 0.24, double turn_slip = 0.25);

  /// Ways of both tracks since the start [m]. The first call is the beginning.
  void update(double left_m, double right_m);

  /// Where the robot is by the encoders alone: smooth, for what is near.
  const Place& reckoned() const { return reckoned_; }
  /// Where it is with the heading aligned on walls: for the chart.
  const Place& charted() const { return charted_; }
  /// Way ahead, less the way back [m].
  double way_m() const { return way_m_; }
  /// Direction of a wall in turns of 90 degrees, left positive, of which the robot stands at a slant (from the wall's direction to the robot's, left positive [rad]).
  int quarter(double slant) const {
    return static_cast<int>(std::lround((charted_.heading - slant) / kQuarter));
  }
  /// Share of turns that is lost, as learnt from walls.
  double turn_slip() const { return slip_; }

  /// Sets the place for the chart.
  void place(const Vec2& at, double heading) { charted_ = {at, heading}; }
  /// Takes back a way, as if it had not been driven.
  void take_back(double way_m) { way_m_ -= way_m; }
  /// Takes the wall's direction, the present heading less `slant`, as zero.
  void align_first(double slant);
  /// Takes the wall's direction as the multiple of 90 degrees next to it, after a turn. The error also teaches how much the tracks slip.
  void align_after_turn(double slant);
  /// Corrects the heading by a share of the error, where the wall is within some degrees of a multiple of 90 degrees, and more after a curve: others are no walls of this kind.
  void align_on_way(double slant);

 private:
  /// What is to be added to the heading so that the wall is along an axis.
  double heading_error(double slant) const;
  void correct(double slant, double share);

  double wheel_base_m_;
  double slip_;
  bool begun_ = false;
  double left_m_ = 0.0, right_m_ = 0.0;
  Place reckoned_, charted_;
  double way_m_ = 0.0;
  int turns_ = 1;            // of which the slip is learnt, and what was known before
  double curve_ = 0.0;       // turns of the tracks to both sides, since a wall was along an axis
  double track_turn_ = 0.0;  // of the tracks, since the heading was aligned
};

}  // namespace hallway::wall_follower
