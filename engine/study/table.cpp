// SPDX-License-Identifier: MIT
#include "study/table.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "batch/table.hpp"

namespace hallway::study {
namespace {

bool is_number(const Field& field) {
  return std::holds_alternative<double>(field) && std::isfinite(std::get<double>(field));
}

std::string csv_text(const Field& field) {
  if (const auto* text = std::get_if<std::string>(&field)) return batch::csv_field(*text);
  return is_number(field) ? format_double(std::get<double>(field)) : "";
}

std::string shown_text(const Field& field) {
  if (const auto* text = std::get_if<std::string>(&field)) return printable(*text);
  if (!is_number(field)) return "-";
  const double value = std::get<double>(field);
  if (value == std::round(value) && std::abs(value) < 1e9) return fmt::format("{:.0f}", value);
  return fmt::format("{:.4g}", value);
}

}  // namespace

void Table::add(std::vector<Field> row) {
  if (row.size() != columns.size())
    throw Error(ErrorCode::kInternal, "a row of the table " + file + " is not as wide as its head");
  rows.push_back(std::move(row));
}

std::string print_csv(const Table& table) {
  std::string text;
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    text += (i > 0 ? "," : "") + batch::csv_field(table.columns[i]);
  text += '\n';
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) text += (i > 0 ? "," : "") + csv_text(row[i]);
    text += '\n';
  }
  return text;
}

nlohmann::ordered_json to_json(const Table& table) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const auto& row : table.rows) {
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < row.size(); ++i) {
      nlohmann::ordered_json& member = object[table.columns[i]];
      if (const auto* text = std::get_if<std::string>(&row[i])) {
        member = printable(*text);
      } else if (is_number(row[i])) {
        member = std::get<double>(row[i]);
      }
    }
    rows.push_back(std::move(object));
  }
  return rows;
}

std::string print_text(const Table& table) {
  std::vector<std::size_t> widths;
  for (const std::string& column : table.columns) widths.push_back(column.size());
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], shown_text(row[i]).size());
  }
  std::vector<bool> numeric(table.columns.size(), false);
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) numeric[i] = numeric[i] || is_number(row[i]);
  }
  std::string text;
  const auto add = [&](const std::string& one, std::size_t i) {
    text += numeric[i] ? fmt::format("{:>{}}", one, widths[i]) : fmt::format("{:<{}}", one, widths[i]);
    text += i + 1 < widths.size() ? "  " : "\n";
  };
  for (std::size_t i = 0; i < widths.size(); ++i) add(table.columns[i], i);
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) add(shown_text(row[i]), i);
  }
  return text;
}

}  // namespace hallway::study
