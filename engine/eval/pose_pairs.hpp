// SPDX-License-Identifier: MIT
#pragma once

#include "eval/sequence.hpp"
#include "geometry/se3.hpp"

namespace hallway::eval {

/// A true pose beside an estimated one.
struct PosePair {
  Pose T_world_body;         ///< reference; unit quaternion
  Pose T_map_body;           ///< estimate; unit quaternion
  double t_s = 0.0;          ///< time, of the reference
  double travelled_m = 0.0;  ///< along the reference, from its first pose
};

/// Which motion of an estimate is not its error.
enum class Alignment {
  kNone,        ///< both are in one frame
  kFirstPose,   ///< the first pair coincides, position and orientation
  kRigid,       ///< positions are fitted by a rigid motion: SE(3), Umeyama 1991 without scale
  kSimilarity,  ///< the same with scale: Sim(3), Umeyama 1991
};

/// A motion of an estimate into the world: p -> to + scale * q (p - from). It is kept with the centres of both sides, so that places
/// far from the origin lose no digits.
struct PathFit {
  double scale = 1.0;
  Quat q = Quat::Identity();
  Vec3 from = Vec3::Zero();  ///< map frame
  Vec3 to = Vec3::Zero();    ///< world
  /// Whether the positions leave no rotation open: not all near one line. False for rigid fits that do.
  bool rotation_known = true;

  Vec3 operator*(const Vec3& point) const { return to + scale * (q * (point - from)); }
  /// Where the origin of the map frame goes.
  Vec3 translation() const { return *this * Vec3::Zero(); }
};

/// The motion of that kind. Throws Error{kBadInput} where there is none: no pairs, fewer than three pairs for a fit, an estimate
/// that does not move where its scale is asked for. O(n).
PathFit align(const Sequence<PosePair>& pairs, Alignment alignment);

}  // namespace hallway::eval
