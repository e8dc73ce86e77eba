// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "log_input.hpp"

namespace hallway::cli {

/// Writes CSV tables for spreadsheets to an empty folder: frames, sensors, and for each sensor its readings and their elements (docs/formats.md). Throws
/// Error{kUsage} for a sensor that there is not, Error{kIo}.
/// @param sensor  the one whose tables are written; empty: all
void write_tables(OpenedLog& opened, const std::string& sensor, const std::filesystem::path& folder,
                  bool quiet);

}  // namespace hallway::cli
