// SPDX-License-Identifier: MIT
#include "log/line_reader.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/text.hpp"

namespace hallway::log {

LineReader::LineReader(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
}

bool LineReader::next() {
  while (!rest_.empty()) {
    ++number_;
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) {
      if (trim(std::exchange(rest_, {})).empty()) return false;
      throw error("the last line has no line end: the file seems to be cut off here");
    }
    line_ = trim(rest_.substr(0, end));
    rest_.remove_prefix(end + 1);
    if (!line_.empty()) return true;
  }
  return false;
}

Error LineReader::error(const std::string& message, const std::string& element) const {
  const auto line = std::min<std::int64_t>(number_, std::numeric_limits<int>::max());
  return Error(ErrorCode::kBadInput, message, {file_, static_cast<int>(line), element});
}

}  // namespace hallway::log
