// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "contact/obstacles.hpp"

namespace hallway::contact {

/// Where a body stands on its floor: three or four points of contact.
struct Wheels {
  std::vector<Vec2> at;                ///< x and y in the body's frame, metres; their z is 0
  Vec2 centre_of_mass = Vec2::Zero();  ///< within the polygon of the wheels
};

/// What wheels get over. Metres, radians.
struct GroundLimits {
  double step_m = 0.02;  ///< greatest height that a wheel climbs at once, [0, 10]
  /// Greatest depth that it goes down at once, [0, 10]. A wheel that does not carry hangs by at most nine tenths of it.
  double ledge_m = 0.02;
  double slope_rad = 0.35;    ///< greatest tilt of the body, [0, 1]
  double clearance_m = 0.02;  ///< height up to which a wheel looks for what is in its way, [0, 10]
  bool may_hang = false;      ///< true: a wheel may be in the air while the others carry the centre of mass
};

/// Why a body does not stand somewhere.
enum class GroundFault {
  kLedge,  ///< a wheel would go down by more than `ledge_m`, or hang too far above its floor
  kStep,   ///< something higher than `step_m` and within `clearance_m` at a wheel
  kSlope,  ///< the body would tilt by more than `slope_rad`
};

/// A pose on the floor, or why there is none.
struct Stance {
  Pose pose{};                         ///< T_world_body
  std::optional<GroundFault> fault{};  ///< none: the body stands
  std::size_t wheel = 0;               ///< which is at fault, index in Wheels::at
  Vec3 where = Vec3::Zero();           ///< where that wheel is, world frame
};

/// The floor under wheels: the highest points of triangles, whichever way these face.
///
/// A wheel is a point on the vertical where it is while the body is level: so the stance depends on place and heading alone, and a body that stands, stands
/// there again. On a plane the wheels of the tilted body are in that plane as well. A body of three wheels stands on the plane of their supports; one of four on the plane of those
/// three that no other support exceeds and whose triangle holds the centre of mass. Where that is on both diagonals, the first such
/// three in the order of the wheels. On a level floor of height z the pose has exactly that z and no tilt.
class Ground {
 public:
  /// Keeps a reference to the obstacles. Throws Error{kBadInput} for other than three or four wheels, wheels that span no triangle or are
  /// farther than 1000 m from the origin, a centre of mass that they do not carry, and limits out of range.
  Ground(const Obstacles& obstacles, Wheels wheels, const GroundLimits& limits);

  /// The stance at the x, y and heading of `guess`. Limits are measured from where `guess` has the wheels.
  /// O(log n + triangles under the body).
  Stance stand(const Pose& guess) const { return stand(guess, limits_); }

  /// The same for a body that comes down from above: steps and ledges of up to its wheels' reach on the greatest slope count as floor. No wheel may hang.
  Stance settle(const Pose& guess) const;

  /// Height of the highest point of a triangle at that x and y with z in [low, high], if there is one.
  std::optional<double> floor_at(const Vec2& at, double low, double high) const;

  const Wheels& wheels() const { return wheels_; }

 private:
  /// z = height + slope . (x, y), about the body's origin.
  struct Plane {
    double height = 0.0;
    Vec2 slope = Vec2::Zero();
  };

  Stance stand(const Pose& guess, const GroundLimits& limits) const;
  /// A wheel that would go down too far, from its height before, or would hang too far above the floor.
  std::optional<std::size_t> over_ledge(const Plane& plane, const std::vector<Vec3>& supports,
                                        const std::vector<double>& before, const GroundLimits& limits) const;
  std::optional<Plane> fit(const std::vector<Vec3>& supports) const;

  const Obstacles& obstacles_;
  Wheels wheels_;
  GroundLimits limits_;
  double reach_ = 0.0;                             ///< of the farthest wheel
  std::vector<std::array<std::size_t, 3>> carry_;  ///< the wheels that hold the centre of mass between them
};

}  // namespace hallway::contact
