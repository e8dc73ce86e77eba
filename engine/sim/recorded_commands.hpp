// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

#include "drive/command_table.hpp"

namespace hallway::sim {

/// The commands of a file: a table (drive::CommandTable), the table drive.csv of a run, or a log. Of runs and their logs these are the commands that the
/// drive obeyed; of a log that says nothing of a drive, as a robot's, those that the plugin gave. Throws Error{kIo} if the file cannot be read,
/// Error{kBadInput} with file and cause for a file that is none of these, and one without commands.
/// @param latency_ns  of the drive that is to obey them: with that of the run, they act when they acted then
drive::CommandTable read_commands(const std::filesystem::path& file, std::int64_t latency_ns);

}  // namespace hallway::sim
