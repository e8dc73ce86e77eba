// SPDX-License-Identifier: MIT
#include "log/command_file.hpp"

#include <algorithm>
#include <fstream>
#include <string>

#include "base/error.hpp"

namespace hallway::log {

std::string print_commands(std::span<const IterationCommand> commands) {
  const bool is_wide =
      std::ranges::any_of(commands, [](const auto& command) { return command.lateral_m_s != 0.0; });
  RowWriter out(',');
  out.word(is_wide ? kLateralCommandColumns : kCommandColumns).end_row();
  for (const IterationCommand& command : commands) {
    is_wide ? add_lateral_row(out, command) : add_row(out, command);
  }
  return out.take();
}

CommandFile::CommandFile(const std::filesystem::path& path) : path_(path) {
  rows_.emplace(path, ',', kCommandColumns);
}

void CommandFile::add(const IterationCommand& command) {
  if (!is_wide_ && command.lateral_m_s != 0.0) widen();
  is_wide_ ? add_lateral_row(rows_->next_row(), command) : add_row(rows_->next_row(), command);
}

void CommandFile::widen() {
  rows_->close();
  std::filesystem::path narrow = path_;
  narrow += ".narrow";
  std::error_code problem;
  std::filesystem::rename(path_, narrow, problem);
  std::ifstream before(narrow);
  std::string row;
  std::getline(before, row);
  if (problem || !before) throw Error(ErrorCode::kIo, "cannot be read again", {.file = path_.string()});
  rows_.emplace(path_, ',', kLateralCommandColumns);
  while (std::getline(before, row)) rows_->next_row().word(row).number(0.0).end_row();
  if (before.bad()) throw Error(ErrorCode::kIo, "cannot be read again", {.file = path_.string()});
  std::filesystem::remove(narrow, problem);
  is_wide_ = true;
}

}  // namespace hallway::log
