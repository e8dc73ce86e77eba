// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace hallway::log {

/// Builds rows of text. Numbers are the shortest decimals that read back as the same value.
class RowWriter {
 public:
  /// @param separator  between the fields of a row
  explicit RowWriter(char separator) : separator_(separator) {}

  RowWriter& word(std::string_view text);
  RowWriter& whole(std::uint64_t value);
  /// Throws Error{kInternal} if the value is not finite: it could not be read back.
  RowWriter& number(double value);
  RowWriter& numbers(std::span<const double> values);
  void end_row();
  /// Bytes of the text so far.
  std::size_t size() const { return text_.size(); }
  /// The text so far, which is given away.
  std::string take() { return std::exchange(text_, {}); }

 private:
  void separate();

  char separator_;
  bool row_begun_ = false;
  std::string text_;
};

/// The text of a table: its first line, then a row for each item, as add_row() has it. Throws as add_row() does.
template <typename Rows>
std::string print_table(std::string_view columns, const Rows& rows) {
  RowWriter out(',');
  out.word(columns).end_row();
  for (const auto& row : rows) add_row(out, row);
  return out.take();
}

}  // namespace hallway::log
