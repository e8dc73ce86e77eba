// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "drive/actuation.hpp"
#include "drive/limits.hpp"
#include "drive/motion.hpp"
#include "drive/profile.hpp"
#include "drive/spec.hpp"
#include "drive/wheels.hpp"

namespace hallway::drive {

/// How a command is obeyed.
struct Obeyed {
  Command command{};              ///< within the limits
  Clamps clamps{};                ///< what was changed
  std::int64_t acts_from_ns = 0;  ///< when its effect begins
};

/// A piece of the motion: body and wheels over the same time.
struct Motion {
  TwistRamp body{};    ///< true twist of the body
  WheelRamp wheels{};  ///< rims
};

/// A drive that obeys commands: limits, latency, ramps, noise and slip. A value: a copy goes on as the original does.
///
/// Time begins at 0 with the robot at rest. The driven parts (forward, lateral, and angular or steering) go to their targets on ramps, each at its own
/// rates. Where a wheel would be faster than max_speed_m_s on the way, all parts go on one line and arrive together, at the pace of the slowest. The
/// true twist is the effect of the driven one at the vertices of the ramps and, where a disturbance varies or the steering moves, every 10 ms; it is
/// linear between these times, by definition. So the motion does not depend on how time is divided, but for rounding.
class Drive {
 public:
  /// Throws Error{kBadInput} for a spec that check() refuses.
  Drive(const DriveSpec& spec, std::uint64_t seed);

  /// Gives a command at a time. It acts from `t_ns` + latency on, or from the present on if that is over, until the next one. The parts must be finite, of any
  /// size; throws Error{kInternal} if not. Of two that act from the same time on, the later call counts.
  Obeyed command(std::int64_t t_ns, const Command& command);
  /// The zero command: the drive decelerates as after any other one. An ackermann drive keeps its steering.
  Obeyed halt(std::int64_t t_ns);

  /// Goes on to a time and gives the motion until then, in order and without gaps; none if it is the present. Throws Error{kInternal} for a time that is
  /// over. Cost: one piece per vertex, command and knot.
  std::vector<Motion> advance(std::int64_t to_ns);

  /// A contact gave the body another twist at the present time; the wheels go on. The difference from the wheels' twist fades at the limits of acceleration.
  void set_twist(const PlanarTwist& twist);
  /// Body and wheels are at rest at the present time, as motors that are blocked. The drive then accelerates anew, as last commanded.
  void stop();

  std::int64_t present_ns() const { return present_ns_; }
  /// The true twist of the body.
  PlanarTwist twist() const;
  /// The twist that the motors drive, without noise and slip.
  PlanarTwist driven() const { return driven_at(present_ns_); }
  /// The steering angle, positive to the left; 0 for what does not steer [rad].
  double steering_rad() const;
  /// The way of each rim since time 0, for encoders [m].
  const PerWheel& wheel_travel_m() const { return travel_m_; }
  const DriveSpec& spec() const { return spec_; }

 private:
  struct Pending {
    std::int64_t acts_from_ns = 0;
    LimitedCommand limited{};
  };
  /// The effect from a time to the next vertex or knot.
  struct Plan {
    std::int64_t begin_ns = 0;
    std::int64_t end_ns = 0;
    Effect from{};
    Effect to{};
  };
  using Parts = std::array<Profile, 3>;  // forward, lateral, and angular or steering

  bool is_steered() const { return spec_.kind == DriveKind::kAckermann; }
  std::array<Rates, 3> rates() const;
  PlanarTwist driven_at(std::int64_t t_ns) const { return driven_at(driven_, t_ns); }
  PlanarTwist driven_at(const Parts& parts, std::int64_t t_ns) const;
  bool wheels_stay_within(const Parts& parts) const;
  void go_to(const std::array<double, 3>& targets);
  void act(const LimitedCommand& limited);
  void begin_turn(double angular_rad_s);
  void act_on_pending();
  Effect effect_at(std::int64_t t_ns) const;
  PlanarTwist body_at(std::int64_t t_ns) const;
  void cut_plan();
  void plan();
  Motion piece(std::int64_t end_ns) const;

  DriveSpec spec_;
  Actuation actuation_;
  std::int64_t present_ns_ = 0;
  std::vector<Pending> pending_;  // by time
  int turn_sign_ = 0;             // of the command that acts
  Parts driven_;
  Parts push_;  // what contacts added to the body's twist
  Plan plan_;
  PerWheel travel_m_{};
};

}  // namespace hallway::drive
