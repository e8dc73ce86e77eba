// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "contact/contact_points.hpp"
#include "contact/ground.hpp"
#include "contact/part.hpp"
#include "contact/sweep_check.hpp"
#include "contact/twist_limits.hpp"

namespace hallway::contact {

/// The gap that a body keeps to what it meets, metres. Parts of a motion end with at least half of it, or with what they began with.
inline constexpr double kClearance = 1e-4;
/// An obstacle nearer than this that the body moves against is a contact, metres.
inline constexpr double kContactRange = 1e-3;
/// A part moves a body by at most this far, metres, and turns it by at most this much, radians: so often the floor is looked at.
inline constexpr double kLongestPart = 0.02;
inline constexpr double kGreatestPartTurn = 0.05;
/// A body for which not even a part of this length is free stands still, metres.
inline constexpr double kShortestPart = 5e-5;
/// How long it does so before it is tried again.
inline constexpr std::int64_t kStandingPart_ns = 10'000'000;

/// What a body does at obstacles.
struct MoveOptions {
  bool slide = true;      ///< false: it stops
  double gyration = 0.3;  ///< radius of gyration, metres: turns count as speeds at this radius
};

/// What the body was pressed against in a part.
struct Press {
  /// Of a ground fault: where the wheel is, with the normal against its way; gap and obstacle are 0.
  ContactPoint contact{};
  std::optional<GroundFault> fault{};  ///< none: an obstacle
  std::size_t wheel = 0;               ///< of a ground fault
  double speed_m_s = 0.0;              ///< of the wanted twist against it
};

/// What became of the beginning of a wanted motion.
struct Move {
  Part part{};                   ///< what the body does
  bool stands = false;           ///< it was to move, and stands still during the part
  std::vector<Press> pressed{};  ///< in the order in which they were met
};

/// Moves a body in its floor plane, part by part.
///
/// Each part is proved to be free by SweepCheck, and its end is a stance of Ground. Where the wanted part is not free, it is halved; where
/// what blocks it is in contact, the twist is limited there (twist_limits.hpp). What brings the body nearer besides the twist, as a floor that
/// tilts it, counts too. A limit enters only if a trial without it fails, and a triangle behind the plane of a nearer one has no normals of its
/// own: neighbours of the triangle that the body slides along do not stop it at their edges.
class Mover {
 public:
  /// Keeps references.
  Mover(const BodyShape& shape, const Obstacles& obstacles, const Ground& ground, const MoveOptions& options)
      : shape_(shape), obstacles_(obstacles), ground_(ground), options_(options), check_(shape, obstacles) {}

  /// The first part of a motion, of 1 ns up to its whole duration. At most some 500 trials, seldom more than ten.
  /// @param pose    where the body stands, clear of all obstacles
  /// @param wanted  as check_ramp() has it
  Move next(const Pose& pose, std::int64_t begin_ns, const TwistRamp& wanted);

  /// Proves parts of other motions.
  SweepCheck& check() { return check_; }

 private:
  struct Trial;

  std::int64_t longest(const TwistRamp& wanted) const;
  std::optional<TwistRamp> limited(const TwistRamp& ramp, const std::vector<ContactPoint>& contacts,
                                   const Pose& pose) const;
  std::vector<TwistLimit> limits_of(const std::vector<ContactPoint>& contacts, const Pose& pose,
                                    double seconds, double ease) const;
  Trial attempt(const Pose& pose, std::int64_t begin_ns, const TwistRamp& ramp, double least);
  std::vector<ContactPoint> contacts_with(const Pose& pose, std::uint32_t blocker);
  std::optional<ContactPoint> next_contact(const Pose& pose, const Pose& end, const TwistRamp& ramp,
                                           std::uint32_t blocker);
  std::vector<Press> pressed_by(const std::vector<ContactPoint>& contacts, const Pose& pose,
                                const TwistRamp& wanted) const;
  Press press_of_wheel(const Pose& pose, const TwistRamp& ramp, std::size_t wheel, GroundFault fault) const;
  std::size_t stepping_wheel(const Pose& pose, const TwistRamp& way, const Pose& end) const;

  const BodyShape& shape_;
  const Obstacles& obstacles_;
  const Ground& ground_;
  MoveOptions options_;
  SweepCheck check_;
};

}  // namespace hallway::contact
