// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "log/line_reader.hpp"

namespace hallway::import {

/// The lines of a text as words that blanks part; and, for files that go on in another form, what follows after the line last read. A line has at most
/// 1 MiB: a file of bytes may have one that is as long as itself.
class WordLines {
 public:
  /// @param content  must outlive this
  /// @param file     its name, for messages
  WordLines(std::string_view content, const std::string& file) : content_(content), lines_(content, file) {}

  /// Goes to the next line that is not blank; false at the end. Throws Error{kBadInput} for a line that is too long or cut off.
  bool next();
  std::string_view line() const { return lines_.line(); }
  const std::vector<std::string_view>& words() const { return words_; }
  /// The bytes after the current line's end.
  std::string_view rest() const;
  /// An error at the current line.
  Error error(const std::string& message) const { return lines_.error(message); }
  /// Word `index` of the current line as a whole number. Throws Error{kBadInput} where it is none or above `most`.
  std::uint64_t whole(std::size_t index, std::uint64_t most) const;

 private:
  std::string_view content_;
  log::LineReader lines_;
  std::vector<std::string_view> words_;
};

}  // namespace hallway::import
