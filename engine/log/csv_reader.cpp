// SPDX-License-Identifier: MIT
#include "log/csv_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "log/observations.hpp"

namespace hallway::log {
namespace {

/// Longest part of a field that an error message repeats.
constexpr std::size_t kEchoedBytes = 40;

/// Splits a line at its commas into `fields`, which keeps its memory from row to row.
void split_fields(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(trim(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

CsvReader::CsvReader(std::string_view text, std::string file, std::vector<CsvColumn> columns)
    : lines_(text, std::move(file)), columns_(std::move(columns)), place_(columns_.size(), kAbsent) {
  read_header();
}

void CsvReader::read_header() {
  if (!lines_.next()) throw lines_.error("the file is empty; a header is needed: " + column_names());
  split_fields(lines_.line(), fields_);
  width_ = fields_.size();
  for (std::size_t place = 0; place < width_; ++place) {
    const auto known = std::ranges::find_if(
        columns_, [&](const CsvColumn& column) { return column.name == fields_[place]; });
    if (known == columns_.end()) continue;
    std::size_t& where = place_[static_cast<std::size_t>(known - columns_.begin())];
    if (where != kAbsent) throw lines_.error(fmt::format("the header has column \"{}\" twice", known->name));
    where = place;
  }
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (!columns_[i].required || has(i)) continue;
    throw lines_.error(fmt::format("the header has no column \"{}\"; needed: {}; it is: {}", columns_[i].name,
                                   column_names(), printable(lines_.line())));
  }
  for (const std::string_view name : fields_) refuse_misspelt(name);
}

/// An optional column under a slightly wrong name would be passed over in silence.
void CsvReader::refuse_misspelt(std::string_view name) const {
  std::vector<std::string> absent;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].name == name) return;
    if (!has(i)) absent.emplace_back(columns_[i].name);
  }
  const std::string hint = suggestion(name, absent);
  if (!hint.empty())
    throw lines_.error(fmt::format("unknown column \"{}\"{}", printable(name, kEchoedBytes), hint));
}

std::string CsvReader::column_names() const {
  std::string needed;
  std::string optional;
  for (const CsvColumn& column : columns_) {
    std::string& names = column.required ? needed : optional;
    if (!names.empty()) names += ',';
    names += column.name;
  }
  return optional.empty() ? needed : needed + " (optional: " + optional + ")";
}

bool CsvReader::next() {
  if (!lines_.next()) return false;
  split_fields(lines_.line(), fields_);
  if (fields_.size() != width_) {
    throw lines_.error(fmt::format("{} fields where the header has {}", fields_.size(), width_));
  }
  return true;
}

std::string_view CsvReader::text(std::size_t column) const {
  return has(column) ? fields_[place_[column]] : std::string_view();
}

Error CsvReader::bad_field(std::size_t column, const std::string& expected) const {
  const std::string_view field = text(column);
  const std::string found = field.empty() ? "nothing" : '"' + printable(field, kEchoedBytes) + '"';
  return lines_.error(fmt::format("{} is needed, {} found", expected, found),
                      fmt::format("column {}", columns_[column].name));
}

double CsvReader::number(std::size_t column) const {
  const auto value = parse_double(text(column));
  if (!value) throw bad_field(column, "a finite number");
  return *value;
}

std::array<double, 3> CsvReader::vector(std::size_t first_column) const {
  return {number(first_column), number(first_column + 1), number(first_column + 2)};
}

std::uint64_t CsvReader::whole(std::size_t column, std::uint64_t max) const {
  const auto value = parse_uint(text(column));
  if (!value || *value > max) throw bad_field(column, fmt::format("a whole number from 0 to {}", max));
  return *value;
}

LandmarkId CsvReader::landmark_or_none(std::size_t column) const {
  const std::string_view field = text(column);
  if (field.empty() || field == "-1") return kNoLandmark;
  return whole(column, kNoLandmark - 1);
}

std::uint32_t CsvReader::later_iteration(std::size_t column, std::int64_t previous) const {
  const auto iteration = static_cast<std::uint32_t>(whole(column, kMaxIteration));
  if (static_cast<std::int64_t>(iteration) <= previous) {
    throw bad_field(column, fmt::format("an iteration above {}", previous));
  }
  return iteration;
}

}  // namespace hallway::log
