// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/core/observation.hpp"
#include "slam_plane/core/options.hpp"

namespace hallway::slam_plane {

/// The coordinates of a wall: `s` along `direction` from `origin`, `r` to the left of it. A line near the s axis is
/// r = offset + s * turn; its ends lie at two values of s.
struct WallBasis {
  Vec2 origin = Vec2::Zero();       ///< [m]
  Vec2 direction = Vec2(1.0, 0.0);  ///< unit, from end a to end b

  double along(const Vec2& p) const { return direction.dot(p - origin); }
  double across(const Vec2& p) const { return cross(direction, p - origin); }
  Vec2 point(double s) const { return origin + s * direction; }
  /// Whether a direction differs by more than an angle below 90 degrees, of which the sine is given.
  bool differs(const Vec2& other, double sine) const {
    return direction.dot(other) <= 0.0 || std::abs(cross(direction, other)) > sine;
  }
};

/// A quadratic form in what is sought of a wall in a basis: x'Hx/2 - b'x for x = (turn [rad], offset [m]) of its line, and
/// likewise with E and f for the places of its ends [m].
struct WallForm {
  Mat2 h = Mat2::Zero();
  Vec2 b = Vec2::Zero();
  Mat2 e = Mat2::Zero();
  Vec2 f = Vec2::Zero();

  void add(const WallForm& other);
  /// Takes an end out: what the other one then tells by itself is kept.
  void drop_end(int end);
};

/// All that one submap knows of one wall, as sums: observations come and are never kept. The submap's frame.
///
/// The line: count, middles' sum and second moments, directions' sum; it is equal in effect to keeping every observation. The ends: what
/// certain corners tell of their places along the wall, together since a shift of the observation along the wall moves both.
class WallEvidence {
 public:
  /// Adds an observation that a frame at T_submap_robot saw; `corner` says which of its ends count. O(1).
  void add(const Pose2& T_submap_robot, const AssociatedObservation& observation, const bool (&corner)[2],
           const Noise& noise);

  /// Adds what another submap knows; T_this_other moves from its frame to this one. O(1).
  void add(const Pose2& T_this_other, const WallEvidence& other);

  /// Forgets what it knows of an end.
  void forget_end(int end);

  /// What it tells in a basis of the submap's frame.
  WallForm form(const WallBasis& basis, const Noise& noise) const;

  std::uint32_t count() const { return count_; }
  /// The first observation's line.
  WallBasis basis() const { return {origin_, direction_}; }
  /// How far it was seen, certain or not [m].
  const Vec2& reach(int end) const { return reach_[end]; }

 private:
  void extend(const Vec2 (&seen)[2]);

  std::uint32_t count_ = 0;
  Vec2 origin_ = Vec2::Zero();  // sums are about it
  Vec2 direction_ = Vec2(1.0, 0.0);
  Vec2 sum_ = Vec2::Zero();                       // of middles
  Mat2 square_ = Mat2::Zero();                    // of middles
  double turn_ = 0.0;                             // sum of angles from direction_
  Mat2 ends_ = Mat2::Zero();                      // information of the ends' places
  Vec2 place_[2] = {Vec2::Zero(), Vec2::Zero()};  // its product with the ends
  Vec2 reach_[2] = {Vec2::Zero(), Vec2::Zero()};
};

/// Where a wall is.
struct WallEstimate {
  WallBasis basis;                            ///< on the line: its turn and offset in this basis are 0
  double p_tt = 0.0, p_to = 0.0, p_oo = 0.0;  ///< covariance of turn and offset
  double end[2] = {0.0, 0.0};                 ///< places of the corners, where known
  double variance[2] = {0.0, 0.0};
  double covariance = 0.0;         ///< of the two ends
  bool known[2] = {false, false};  ///< that there is a corner
  double reach[2] = {0.0, 0.0};    ///< from where to where it was seen, at least to the corners

  /// Where it was seen up to.
  Vec2 extent(int k) const { return basis.point(reach[k]); }
  /// Variance of the line's place at s [m^2].
  double variance_at(double s) const { return p_oo + 2.0 * s * p_to + s * s * p_tt; }
};

/// Solves a form: the estimate's line and ends where its sums are minimal. False where the form leaves the line unobservable.
/// `use_end`: which ends to solve for. Reaches are left as they are.
bool solve(const WallForm& form, const WallBasis& basis, const bool (&use_end)[2], WallEstimate& estimate);

}  // namespace hallway::slam_plane
