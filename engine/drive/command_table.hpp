// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "drive/motion.hpp"

namespace hallway::drive {

/// A command and the time that it is given at.
struct TimedCommand {
  std::int64_t t_ns = 0;
  Command command{};
};

/// Commands of a file. Each holds from its time until the next one's.
class CommandTable {
 public:
  /// Throws Error{kBadInput} for no commands, and for times that do not grow or are below 0.
  explicit CommandTable(std::vector<TimedCommand> commands);
  /// From a CSV file with the header `t_ns,forward_m_s,angular_rad_s` or `t_ns,forward_m_s,angular_rad_s,lateral_m_s`. Times are whole numbers from 0 on and
  /// grow from row to row; the other numbers are finite. Lines may end with CR LF. Throws Error{kIo} if the file cannot be read, Error{kBadInput} with file,
  /// line and cause for anything else, and for a table without rows.
  static CommandTable read(const std::filesystem::path& file);
  /// The same for a text; `name` is the file's in messages.
  static CommandTable parse(std::string_view text, const std::string& name);

  /// In the order of time, at least one.
  const std::vector<TimedCommand>& commands() const { return commands_; }
  /// The command that holds at a time; zero before the first one.
  Command at(std::int64_t t_ns) const;

 private:
  CommandTable() = default;

  std::vector<TimedCommand> commands_;
};

}  // namespace hallway::drive
