// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "log/landmark_id.hpp"
#include "log/line_reader.hpp"

namespace hallway::log {

/// A column that a reader knows.
struct CsvColumn {
  std::string_view name;
  bool required = true;
};

/// Goes through a CSV table of numbers and plain words (no quotes), row by row. The header decides where each column
/// stands; columns of other names are passed over, unless one looks like a misspelt name of an absent one. Every error is an
/// Error{kBadInput} with file and line.
class CsvReader {
 public:
  /// Reads the header. `columns` are referred to by their index from here on.
  ///
  /// @param text  the file's content; must outlive the reader
  /// @param file  its name, for messages
  CsvReader(std::string_view text, std::string file, std::vector<CsvColumn> columns);

  /// Whether the header has this column.
  bool has(std::size_t column) const { return place_[column] != kAbsent; }
  /// Goes to the next row; false at the end.
  bool next();

  /// The field as text, blanks at its ends taken off; empty if the column is absent.
  std::string_view text(std::size_t column) const;
  /// The field as a finite number.
  double number(std::size_t column) const;
  /// Three numbers from neighbouring columns.
  std::array<double, 3> vector(std::size_t first_column) const;
  /// The field as a whole number from 0 to `max`.
  std::uint64_t whole(std::size_t column, std::uint64_t max) const;
  /// The field as a landmark's id; nothing and -1 are kNoLandmark.
  LandmarkId landmark_or_none(std::size_t column) const;
  /// The field as an iteration number that is above `previous` (-1 before the first one).
  std::uint32_t later_iteration(std::size_t column, std::int64_t previous) const;
  /// An error at a field of the current row: what it should be, and what it is.
  Error bad_field(std::size_t column, const std::string& expected) const;
  /// An error at the current row.
  Error error(const std::string& message) const { return lines_.error(message); }

 private:
  static constexpr std::size_t kAbsent = static_cast<std::size_t>(-1);

  void read_header();
  void refuse_misspelt(std::string_view name) const;
  std::string column_names() const;

  LineReader lines_;
  std::vector<CsvColumn> columns_;
  std::vector<std::size_t> place_;        ///< by column of columns_: where it stands in a row, or kAbsent
  std::vector<std::string_view> fields_;  ///< of the current row
  std::size_t width_ = 0;                 ///< fields of the header
};

}  // namespace hallway::log
