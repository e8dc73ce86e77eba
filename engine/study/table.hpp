// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace hallway::study {

/// A field of a table: nothing, a text or a number.
using Field = std::variant<std::monostate, std::string, double>;

/// A field of what may not be known.
inline Field field(const std::optional<double>& value) {
  return value ? Field(*value) : Field();
}

/// Rows of equal columns.
struct Table {
  std::string file{};  ///< name without ending
  std::vector<std::string> columns{};
  std::vector<std::vector<Field>> rows{};
  bool clock = false;  ///< holds times, which differ from run to run

  /// Adds a row. Throws Error{kInternal} where it is not as wide as the table.
  void add(std::vector<Field> row);
};

/// The table as CSV (RFC 4180): shortest decimals that read back to the same numbers; nothing for what is not known or not finite.
std::string print_csv(const Table& table);

/// The table as a list of objects; null for what is not known or not finite.
nlohmann::ordered_json to_json(const Table& table);

/// The table for people: columns aligned, four significant digits.
std::string print_text(const Table& table);

}  // namespace hallway::study
