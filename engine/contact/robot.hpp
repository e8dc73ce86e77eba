// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "contact/fall.hpp"
#include "contact/history.hpp"
#include "contact/mover.hpp"

namespace hallway::contact {

/// What a robot is and does at obstacles and ledges.
struct RobotSpec {
  BodyShape shape;  ///< its lowest point at least kLeastGroundClearance above the wheels' plane
  Wheels wheels;
  GroundLimits ground{};  ///< may_hang is set from `falls`
  MoveOptions move{};
  bool falls = false;  ///< true: it drives over ledges and falls; false: a ledge is a contact
};

/// Least height of a body above the plane of its wheels, metres.
inline constexpr double kLeastGroundClearance = 2e-3;
/// A robot starts at least this far from all obstacles, metres.
inline constexpr double kLeastStartGap = 1e-6;
/// A robot moves in at most this many parts in 0.1 s, counted from time 0; then it stands until the next 0.1 s. It is far more than any motion takes that is
/// not jammed.
inline constexpr int kMostParts = 2000;

/// What a robot touches.
enum class TouchKind { kWall, kLedge, kStep, kSlope };

/// A contact that is lost for less than this goes on.
inline constexpr std::int64_t kSameContact_ns = 100'000'000;

/// A contact that a robot is pressed against. One that turns by less than 30 degrees goes on.
struct Touch {
  std::int64_t t_ns = 0;  ///< when it began
  TouchKind kind = TouchKind::kWall;
  Vec3 point = Vec3::Zero();    ///< of the body, or of the wheel; metres, world frame
  Vec3 normal = Vec3::UnitZ();  ///< unit, world frame, from the obstacle to the body
  double gap_m = 0.0;           ///< between body and obstacle; 0 for other kinds than kWall
  double speed_m_s = 0.0;       ///< of the wanted motion against it
  std::uint32_t obstacle = 0;   ///< index in Obstacles; 0 for other kinds than kWall
  std::size_t wheel = 0;        ///< index in Wheels::at; 0 for kWall
};

/// A fall.
struct FallEvent {
  std::int64_t t_ns = 0;
  double height_m = 0.0;
};

/// What happened in one call of Robot::advance().
struct Advance {
  std::vector<Touch> begun{};  ///< contacts that began, in order
  std::vector<Touch>
      touching{};  ///< what the robot was pressed against at the end, with the times at which these began
  std::vector<FallEvent> falls{};
};

/// What a robot did since it was put down.
struct Counts {
  std::uint64_t contacts = 0;  ///< that began
  std::uint64_t falls = 0;
  std::uint64_t parts = 0;    ///< of motion
  std::int64_t stood_ns = 0;  ///< stood still though a motion was wanted
  double distance_m = 0.0;    ///< that its origin moved, falls aside
};

/// How a robot stands after it was put down.
enum class Start {
  kStands,
  kInObstacle,  ///< overlaps a triangle, or is nearer to it than kLeastStartGap
  kInSolid,     ///< its middle is in the solid
  kNoFloor,     ///< nothing below
  kNoStance,    ///< the floor is too uneven or too steep, or there is a ledge under a wheel
};

/// A rigid body on wheels among obstacles that do not move.
///
/// Invariants: at every time of its history the body and every triangle are apart, proved as SweepCheck does. The same calls give the same bytes. Where the
/// robot is in no contact and the floor is level, its pose is the integral of its twist to rounding, however time is cut. Not for
/// several threads at once.
class Robot {
 public:
  /// Keeps a reference to the obstacles. Throws Error{kBadInput} as Ground does, for a gyration out of [1e-3, 1e3], and for a body that is lower than
  /// kLeastGroundClearance.
  Robot(const Obstacles& obstacles, RobotSpec spec);
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  /// Puts the robot on the highest floor at or below a place; history, counts and pushes begin anew. After any other result than kStands it does not move.
  /// Throws Error{kBadInput} for numbers that are not finite or beyond kGreatestCoordinate.
  /// @param place     world frame, metres; a floor up to its z + 1 mm is found
  /// @param is_solid  whether a point is in the solid, whose boundary alone is among the obstacles; may be empty
  Start put(const Vec3& place, double yaw_rad, std::int64_t at_ns,
            const std::function<bool(const Vec3&)>& is_solid = {});

  /// Takes the robot up, at the present time, and puts it down elsewhere as put() does, at rest and in no contact. History and counts go on; pushes end.
  /// After any other result than kStands nothing has changed. Throws as put() does.
  Start carry(const Vec3& place, double yaw_rad, const std::function<bool(const Vec3&)>& is_solid = {});

  /// Drives a list of ramps, one after the other. All are checked first: throws Error{kBadInput} as check_ramp() does, and nothing has moved.
  Advance advance(std::span<const TwistRamp> ramps);

  /// Adds a twist, in the body's frame, to what is wanted for a duration from now on; pushes add up. With them a twist may exceed the limits of
  /// check_twist(); it is then clamped to them. Throws as check_ramp() does.
  void push(const PlanarTwist& twist, std::int64_t duration_ns);

  /// Whether a push acts at the present time.
  bool is_pushed() const;

  std::int64_t now_ns() const { return history_.end_ns(); }
  const Pose& pose() const { return pose_; }
  /// The twist at now_ns(), in the body's frame: what is left of the wanted one. Zero after a fall.
  const PlanarTwist& twist() const { return twist_; }
  /// True after a fall with nothing below, or a start that was no stance: the robot stays where it was.
  bool is_lost() const { return is_lost_; }
  const Counts& counts() const { return counts_; }
  const History& history() const { return history_; }
  /// Frees the history before a time.
  void forget_before(std::int64_t t_ns) { history_.forget_before(t_ns); }

 private:
  struct Push {
    PlanarTwist twist;
    std::int64_t end_ns;
  };

  /// A contact that the robot is or was pressed against.
  struct Known {
    Touch touch;
    std::int64_t last_ns;
  };

  Start find_stance(const Vec3& place, double yaw_rad, const std::function<bool(const Vec3&)>& is_solid,
                    Pose& found);
  TwistRamp with_pushes(TwistRamp ramp);
  void drive(const TwistRamp& ramp, Advance& advance);
  void note(const Move& move, Advance& advance);
  bool fall(const Move& move, Advance& advance);
  void rest(std::int64_t duration_ns);

  const Obstacles& obstacles_;
  RobotSpec spec_;
  Ground ground_;
  Mover mover_;
  History history_;
  std::vector<Push> pushes_;
  std::vector<Known> known_;
  std::optional<Move> standing_;  ///< the last move, if it stood still for a wanted twist that did not change
  PlanarTwist standing_twist_{};
  Counts counts_;
  Pose pose_{};
  PlanarTwist twist_{};
  std::int64_t slice_ = 0;  ///< of 0.1 s, in which parts_ are counted
  int parts_ = 0;
  bool is_lost_ = true;
};

}  // namespace hallway::contact
