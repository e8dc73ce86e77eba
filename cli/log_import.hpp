// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "import/kind.hpp"
#include "log_input.hpp"

namespace hallway::cli {

/// How a recording of other programs is to be read; what was not said is empty.
struct ImportChoice {
  std::optional<std::uint32_t> stride{};
  std::string times{};
  std::vector<double> camera{};  ///< fx, fy, cx, cy
  std::optional<double> truth_within_s{};
  std::string topic{};
  std::string truth_topic{};
};

/// Adds the options of ImportChoice.
void add_import_options(Command& command, ImportChoice& choice);

/// Throws Error{kUsage} for options that do not belong to the kind, or to logs of our own where there is none.
void check_import_options(std::optional<import::Kind> kind, const LogChoice& log, const ImportChoice& choice);

/// What a recording is called: the folder's name, or the file's without its end.
std::string recording_name(const std::filesystem::path& path);

/// Opens a recording of other programs. Throws Error{kUsage, kBadInput, kIo}.
OpenedLog open_recording(import::Kind kind, const LogChoice& log, const ImportChoice& choice);

}  // namespace hallway::cli
