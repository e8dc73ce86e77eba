// SPDX-License-Identifier: MIT
#include "log/row_writer.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::log {

void RowWriter::separate() {
  if (row_begun_) text_ += separator_;
  row_begun_ = true;
}

RowWriter& RowWriter::word(std::string_view text) {
  separate();
  text_ += text;
  return *this;
}

RowWriter& RowWriter::whole(std::uint64_t value) {
  std::array<char, 20> digits;
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return word({digits.data(), static_cast<std::size_t>(result.ptr - digits.data())});
}

RowWriter& RowWriter::number(double value) {
  if (!std::isfinite(value)) throw Error(ErrorCode::kInternal, "a number to be written is not finite");
  separate();
  append_double(text_, value);
  return *this;
}

RowWriter& RowWriter::numbers(std::span<const double> values) {
  for (const double value : values) number(value);
  return *this;
}

void RowWriter::end_row() {
  text_ += '\n';
  row_begun_ = false;
}

}  // namespace hallway::log
