// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <vector>

#include "contact/robot.hpp"
#include "drive/command_table.hpp"
#include "drive/drive.hpp"
#include "drive/follower.hpp"
#include "log/drive_tables.hpp"
#include "map/path.hpp"
#include "sim/driven_world.hpp"
#include "sim/motion.hpp"
#include "sim/scenario.hpp"
#include "sim/wheel_history.hpp"

namespace hallway::sim {

/// What plugins answered to a frame, for the drive.
struct DriveAnswer {
  std::optional<drive::Command> command{};  ///< finite
  bool failed = false;                      ///< they failed at this frame or before it
};

using log::CommandCause;

/// The command in force from a frame on.
struct CommandInForce {
  drive::Obeyed obeyed{};
  CommandCause cause = CommandCause::kNone;
};

/// What a robot did.
struct DriveCounts {
  std::uint64_t commands = 0;  ///< that were given
  std::uint64_t clamped = 0;   ///< of them, with a part beyond a limit
  std::uint64_t left_out = 0;  ///< of them, with a part that the drive cannot do
  std::uint64_t stops = 0;     ///< by the watchdog or the time-out of commands
  double distance_m = 0.0;
  std::uint64_t contacts = 0;
  std::uint64_t falls = 0;
  double stood_s = 0.0;             ///< in contact, though it was to move
  std::uint64_t floor_cells = 0;    ///< of the floor that it can reach (contact::ReachableFloor)
  std::uint64_t cells_visited = 0;  ///< of them, in which it was
  std::uint64_t rooms = 0;          ///< of that floor
  std::uint64_t rooms_entered = 0;
};

/// A robot that its drive moves, frame by frame: body, drive, and who commands it.
///
/// At the time of each frame a command is taken (obey()); then the robot moves to the time of the next one (advance()). Events of the scenario happen at
/// their times; what happens at a frame's time has happened in that frame. The same answers give the same bytes.
/// A contact acts on the drive at the end of a slice of at most 50 ms.
class DrivenRobot final : public Motion {
 public:
  /// Keeps references. Throws Error for a table of commands that cannot be read.
  /// @param path  of the scenario's robot; used where it is driven by its path
  DrivenRobot(const DrivenWorld& world, const Scenario& scenario, const map::Path& path);

  /// The present frame; 0 at first, at rest at the start.
  std::uint32_t frame() const { return frame_; }
  /// Takes the answer to the present frame; once for each.
  CommandInForce obey(const DriveAnswer& answer);
  /// Moves on by one period. @return the contacts that began and the falls, in their order
  const contact::Advance& advance();

  /// The true pose T_world_body at a time up to the present frame's, as far back as sensors of the scenario need it. Throws Error{kInternal} beyond.
  Pose pose_at(std::int64_t t_ns) const override;
  /// Exact: the history's parts are closed forms. Where one part meets the next, e.g. at a contact, and every 2 cm on a floor that is no plane, velocities jump.
  sense::Kinematics kinematics_at(std::int64_t t_ns, double after_s, sense::Side side) const override;
  std::vector<double> breaks_in(std::int64_t begin_ns, std::int64_t end_ns) const override;
  /// Contacts of the body with walls; of a wheel at a ledge, a step or a slope at the wheel, without a gap.
  std::vector<sense::BumpContact> contacts_in(std::int64_t after_ns, std::int64_t until_ns) const override;
  std::vector<double> wheel_travel_at(std::int64_t t_ns) const override { return wheels_.at(t_ns); }
  /// Whether it moves, or was told to, and is still to be stopped after a failure of the plugins that drive it.
  bool is_moving() const;
  /// Finds the reachable floor first: O(n log n) in its size, once for each world.
  DriveCounts counts() const;

 private:
  std::int64_t now_ns() const { return std::int64_t{frame_} * period_ns_; }
  CommandInForce follow();
  CommandInForce read_table();
  CommandInForce hold(const DriveAnswer& answer);
  std::vector<std::int64_t> slice_ends() const;
  void happen(const EventSpec& event, std::size_t index);
  void happen_until(std::int64_t t_ns);
  void move(std::int64_t to_ns, std::vector<TwistRamp>& ramps);
  void note_contacts(const std::vector<contact::Touch>& touches, bool at_their_time);
  std::vector<Vec3> patch_of(const contact::Touch& touch, std::int64_t t_ns) const;
  void give(std::int64_t t_ns, const drive::Command& command, CommandCause cause);

  const DrivenWorld& world_;
  DrivenSpec spec_;
  std::vector<EventSpec> events_;
  std::size_t next_event_ = 0;
  std::int64_t blocked_until_ns_ = 0;  ///< the wheels
  std::int64_t period_ns_;
  std::int64_t kept_ns_;  ///< of the history
  bool has_zones_;        ///< of a robot file
  contact::Robot robot_;
  drive::Drive drive_;
  std::optional<drive::Follower> follower_;
  std::optional<drive::CommandTable> table_;
  std::uint32_t frame_ = 0;
  CommandInForce last_;  ///< the last one that was given
  std::int64_t given_ns_ = 0;
  std::optional<std::int64_t> failed_ns_;   ///< since when no plugin answers
  std::optional<CommandCause> stopped_by_;  ///< since the last command
  DriveCounts counts_;
  contact::Advance advance_;
  WheelHistory wheels_;
  struct PastContact {
    std::int64_t t_ns = 0;
    sense::BumpContact contact;
  };
  std::deque<PastContact> contacts_;               ///< by time
  std::set<std::array<std::int32_t, 3>> visited_;  ///< places of the body, in steps of 0.1 m
};

}  // namespace hallway::sim
