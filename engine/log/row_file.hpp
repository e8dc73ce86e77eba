// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

#include "log/byte_io.hpp"
#include "log/row_writer.hpp"

namespace hallway::log {

/// A table that grows row by row while a run goes on, in memory that does not grow with it. All functions throw Error{kIo}.
class RowFile {
 public:
  /// @param path       a file that is not there yet
  /// @param separator  between the fields of a row
  /// @param header     the first line, without its end; empty for none
  RowFile(const std::filesystem::path& path, char separator, std::string_view header);

  /// Where to put the next row.
  RowWriter& next_row();
  /// No more rows come; what was written stands safely.
  void close();

 private:
  FileOutput file_;
  RowWriter rows_;
};

}  // namespace hallway::log
