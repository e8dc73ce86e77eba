// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "log/row_writer.hpp"

namespace hallway::log {

// Tables of a run whose robot is moved by a drive: what it obeyed, what it touched, and what happened to it.

/// Why a command is in force.
enum class CommandCause {
  kNone,      ///< none came yet
  kPlugin,    ///< a plugin's answer
  kPath,      ///< the follower of a path
  kCommands,  ///< a table of commands
  kHeld,      ///< no new one came: the last one goes on
  kWatchdog,  ///< the plugin failed: the last one goes on
  kTimeout,   ///< zero, since no command came for too long
  kFailure,   ///< zero, since the watchdog ran out
};

/// Its name in files.
std::string_view command_cause_name(CommandCause cause);
/// Empty for a name that is none.
std::optional<CommandCause> command_cause(std::string_view name);

/// The command that the drive obeys from a frame on.
struct ObeyedCommand {
  std::uint32_t iteration = 0;
  double linear_m_s = 0.0;        ///< along the body's x axis, forward positive
  double angular_rad_s = 0.0;     ///< about the body's z axis, to the left positive
  double lateral_m_s = 0.0;       ///< along the body's y axis, to the left positive
  std::int64_t acts_from_ns = 0;  ///< not below 0
  CommandCause cause = CommandCause::kNone;
  /// How it differs from the command as given: names of kCommandChanges joined by `+`; empty where it does not.
  std::string changes{};

  bool operator==(const ObeyedCommand&) const = default;
};

/// What a drive does to a command: limits of the speed, of its sideways part, of the turn, of the steering; a part left out
/// that the drive cannot do; a part within the dead band.
inline constexpr std::array<std::string_view, 6> kCommandChanges{"speed",    "lateral",  "angular",
                                                                 "steering", "left_out", "dead_band"};

/// A contact of the body that began.
struct ContactRow {
  std::int64_t t_ns = 0;  ///< not below 0
  std::string kind{};     ///< `wall`, `ledge`, `step`, `slope`, `fall`: letters a-z, digits and `_`
  std::array<double, 3> position_m{};  ///< world
  std::array<double, 3> normal{};      ///< world, points to the robot
  double speed_m_s = 0.0;

  bool operator==(const ContactRow&) const = default;
};

/// Something that the scenario made happen.
struct EventRow {
  std::int64_t t_ns = 0;  ///< not below 0
  std::string kind{};     ///< `kidnap`, `push`, …: letters a-z, digits and `_`
  std::string what{};  ///< free text on one line, without commas and without blanks at its ends; may be empty

  bool operator==(const EventRow&) const = default;
};

/// The first lines of the tables.
inline constexpr std::string_view kObeyedColumns =
    "iteration,linear_m_s,angular_rad_s,lateral_m_s,acts_from_ns,cause,changes";
inline constexpr std::string_view kContactColumns = "t_ns,kind,x_m,y_m,z_m,nx,ny,nz,speed_m_s";
inline constexpr std::string_view kEventColumns = "t_ns,kind,what";

/// What keeps a row from being read back, as "the kind …"; empty where nothing does. Numbers that are not finite are left to
/// the writers.
std::string problem_of(const ObeyedCommand& row);
std::string problem_of(const ContactRow& row);
std::string problem_of(const EventRow& row);

/// Adds a row. Throws Error{kInternal} for a row that could not be read back.
void add_row(RowWriter& out, const ObeyedCommand& row);
void add_row(RowWriter& out, const ContactRow& row);
void add_row(RowWriter& out, const EventRow& row);

/// Rows from CSV with the columns above in any order. Iterations of commands increase; times of contacts and events do not
/// decrease. Throws Error{kBadInput} with the line of the first thing that is wrong. O(length).
///
/// @param text  the file's content
/// @param file  its name, for messages
std::vector<ObeyedCommand> parse_obeyed_commands(std::string_view text, const std::string& file);
std::vector<ContactRow> parse_contacts(std::string_view text, const std::string& file);
std::vector<EventRow> parse_events(std::string_view text, const std::string& file);

/// The same of a file. Throws Error{kIo} if it cannot be read.
std::vector<ObeyedCommand> read_obeyed_commands(const std::filesystem::path& path);
std::vector<ContactRow> read_contacts(const std::filesystem::path& path);
std::vector<EventRow> read_events(const std::filesystem::path& path);

}  // namespace hallway::log
