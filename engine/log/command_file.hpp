// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "log/commands.hpp"
#include "log/row_file.hpp"

namespace hallway::log {

/// commands.csv while a run goes on, in memory that does not grow with it: in the end the bytes of print_commands(). The first command that moves the
/// robot sideways rewrites the rows before it, once. All functions throw Error{kIo}.
class CommandFile {
 public:
  /// @param path  a file that is not there yet; nor is path + ".narrow"
  explicit CommandFile(const std::filesystem::path& path);

  /// The next row. Throws Error{kInternal} for a number that is not finite.
  void add(const IterationCommand& command);
  /// No more rows come; what was written stands safely.
  void close() { rows_->close(); }

 private:
  void widen();

  std::filesystem::path path_;
  std::optional<RowFile> rows_;
  bool is_wide_ = false;
};

}  // namespace hallway::log
