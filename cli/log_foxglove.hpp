// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "log_input.hpp"
#include "run/feed/foxglove_copy.hpp"

namespace hallway::cli {

/// The MCAP log that is meant: the file itself or, unlike open_log(), that of a run folder which has CSV files too, since only it has the
/// answers. Empty for a log of CSV files.
std::optional<std::filesystem::path> recorded_log(const std::string& log);

/// Writes an MCAP log once more to a new file, with what shows it in Foxglove and, where it stands in a run folder, with the folder's pictures.
/// Prints a warning for damage, and keeps it in `warnings`. Throws Error{kBadInput, kIo}, and Error{kUsage} for options that are for CSV.
/// @return how many frames there are
std::uint32_t write_with_foxglove(const LogChoice& choice, const std::filesystem::path& log,
                                  log::ByteOutput& output, std::vector<std::string>& warnings);

}  // namespace hallway::cli
