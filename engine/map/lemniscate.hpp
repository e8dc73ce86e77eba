// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/se3.hpp"
#include "map/arc_length.hpp"
#include "map/curve_point.hpp"

namespace hallway::map {

/// What a lemniscate path is made from.
struct LemniscateSpec {
  Vec3 crossing = Vec3::Zero();  ///< world, metres
  double heading = 0.0;          ///< at the start, radians about z
  double length_m = 0.0;         ///< of the whole curve in space
  double rise_m = 0.0;           ///< height of the second passage of the crossing above the first
};

/// A figure eight: Bernoulli's lemniscate, r^2 = a^2 cos 2 theta, which starts at the crossing, goes round its first loop to
/// the left and its second to the right. Its height is rise_m sin^2(pi u), u the part of the way on the ground plan: level
/// at the start, `rise_m` when the crossing is passed for the second time, back at the end, smooth throughout.
class Lemniscate {
 public:
  /// Needs length_m > 0 and |rise_m| < length_m / 4.
  explicit Lemniscate(const LemniscateSpec& spec);

  double length_m() const { return spec_.length_m; }
  bool closed() const { return true; }
  /// T_world_body; the distance is taken modulo the length. Arc length is right to 1e-9 of the length.
  Pose at(double distance_m) const;
  /// The same point with derivatives: exact, but for the slope of the curvature, which is a difference of eighth order, right to 1e-9 of its greatest value.
  CurvePoint point(double distance_m) const;

 private:
  /// What pose and derivatives at a distance share.
  struct Spot {
    double u = 0.0;      ///< part of the ground plan's length
    double scale = 0.0;  ///< of the plan, metres
    double slope = 0.0;  ///< of the height, by u
    Vec3 position = Vec3::Zero();
    Vec2 plan_position = Vec2::Zero();  ///< before it is scaled and turned
    Vec2 plan_ahead = Vec2::UnitX();    ///< unit
    Eigen::Rotation2Dd turn{0.0};
  };

  Spot spot_at(double distance_m) const;
  CurvePoint without_slope(double distance_m) const;

  LemniscateSpec spec_;
  double ground_length_;  ///< length of the ground plan, metres
  ArcLength ground_;      ///< of the ground plan with a = 1, over its angle parameter
  ArcLength in_space_;    ///< of the curve, over the part of the ground plan's length
};

}  // namespace hallway::map
