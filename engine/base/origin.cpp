// SPDX-License-Identifier: MIT
#include "base/origin.hpp"

#include <filesystem>

#include "base/text.hpp"

namespace hallway {

std::string origin_of(const std::string& file, int line) {
  if (line == 0) return kCommandLine;
  // The name alone: a run's record must not depend on the folder from which the run was started.
  return printable(std::filesystem::path(file).filename().string()) + ":" + std::to_string(line);
}

bool is_command_line(const Where& where) {
  return where.line == 0 && (where.file == kCommandLine || where.file.starts_with("--"));
}

ErrorCode wrong_value_at(const Where& where) {
  return is_command_line(where) ? ErrorCode::kUsage : ErrorCode::kBadInput;
}

}  // namespace hallway
