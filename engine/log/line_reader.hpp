// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace hallway::log {

/// Goes through a text line by line. A byte order mark at the beginning is passed over; \n and \r\n both end a line. The
/// text must outlive the reader.
class LineReader {
 public:
  LineReader(std::string_view text, std::string file);

  /// Goes to the next line that is not blank; false at the end of the text. Throws Error{kBadInput} for a line without
  /// line end: a file that was cut off in the middle of a number cannot be told from a whole one in any other way.
  bool next();
  /// The current line without its end and without blanks around it.
  std::string_view line() const { return line_; }
  /// An error at the current line.
  Error error(const std::string& message, const std::string& element = {}) const;
  const std::string& file() const { return file_; }

 private:
  std::string_view rest_;
  std::string_view line_;
  std::string file_;
  std::int64_t number_ = 0;
};

}  // namespace hallway::log
