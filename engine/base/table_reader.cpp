// SPDX-License-Identifier: MIT
#include "base/table_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>
#include <variant>

#include "base/origin.hpp"
#include "base/text.hpp"

namespace hallway {
namespace {

std::string describe(const Range& range) {
  return (range.above_low ? "above " : "at least ") + format_double(range.low) + " and at most " +
         format_double(range.high);
}

std::string list_of(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

std::string format_numbers(const Numbers3& numbers) {
  return "[" + format_double(numbers[0]) + ", " + format_double(numbers[1]) + ", " +
         format_double(numbers[2]) + "]";
}

TableReader::TableReader(std::string file, std::string prefix, const TomlTable& table, int line,
                         const std::vector<std::string>& known, std::vector<Setting>& settings)
    : file_(std::move(file)), prefix_(std::move(prefix)), table_(table), line_(line), settings_(settings) {
  for (const TomlEntry& entry : table_) {
    if (std::ranges::find(known, entry.key) == known.end()) {
      throw error(entry.key, "unknown key" + suggestion(entry.key, known));
    }
  }
}

std::string TableReader::full_key(std::string_view key) const {
  return prefix_.empty() ? std::string(key) : prefix_ + "." + std::string(key);
}

int TableReader::line(std::string_view key) const {
  const TomlNode* node = find(table_, key);
  return node != nullptr ? node->line : line_;
}

const std::string& TableReader::file(std::string_view key) const {
  const TomlNode* node = find(table_, key);
  return node != nullptr && !node->file.empty() ? node->file : file_;
}

std::string TableReader::origin(std::string_view key) const {
  const TomlNode* node = find(table_, key);
  return node != nullptr ? origin_of(file(key), node->line) : "default";
}

Error TableReader::error(std::string_view key, const std::string& message) const {
  const TomlNode* node = find(table_, key);
  const bool from_command_line = node != nullptr && node->line == 0;
  Where where{.element = "key `" + printable(full_key(key)) + "`"};
  where.file = from_command_line ? kCommandLine : printable(file(key));
  where.line = line(key);
  return Error(from_command_line ? ErrorCode::kUsage : ErrorCode::kBadInput, message, where);
}

const TomlNode* TableReader::require(std::string_view key, bool has_fallback) const {
  const TomlNode* node = find(table_, key);
  if (node == nullptr && !has_fallback) throw error(key, "is missing");
  return node;
}

void TableReader::note(std::string_view key, std::string value) {
  settings_.push_back({full_key(key), std::move(value), origin(key)});
}

std::string TableReader::text(std::string_view key, const std::optional<std::string>& fallback) {
  const TomlNode* node = require(key, fallback.has_value());
  if (node != nullptr && !std::holds_alternative<std::string>(node->value)) {
    throw error(key, std::string("must be a text, not ") + kind_name(*node));
  }
  const std::string value = node != nullptr ? std::get<std::string>(node->value) : *fallback;
  if (value.empty()) throw error(key, "must not be empty");
  if (value.find('\0') != std::string::npos) throw error(key, "must not hold a zero byte");
  note(key, value);
  return value;
}

std::size_t TableReader::choice(std::string_view key, const std::vector<std::string>& choices,
                                const std::optional<std::size_t>& fallback) {
  const std::string value = text(key, fallback ? std::optional(choices[*fallback]) : std::nullopt);
  const auto found = std::ranges::find(choices, value);
  if (found == choices.end()) {
    throw error(key,
                "\"" + printable(value) + "\" is none of: " + list_of(choices) + suggestion(value, choices));
  }
  return static_cast<std::size_t>(found - choices.begin());
}

std::vector<std::size_t> TableReader::choices(std::string_view key, const std::vector<std::string>& choices) {
  std::vector<std::size_t> chosen;
  const TomlNode* node = find(table_, key);
  if (node == nullptr) {
    for (std::size_t i = 0; i < choices.size(); ++i) chosen.push_back(i);
  } else {
    const auto* items = std::get_if<TomlArray>(&node->value);
    if (items == nullptr) throw error(key, std::string("must be a list of texts, not ") + kind_name(*node));
    for (const TomlNode& item : *items) {
      const auto* name = std::get_if<std::string>(&item.value);
      if (name == nullptr)
        throw error(key, std::string("must be a list of texts; it holds ") + kind_name(item));
      const auto found = std::ranges::find(choices, *name);
      if (found == choices.end()) {
        throw error(
            key, "\"" + printable(*name) + "\" is none of: " + list_of(choices) + suggestion(*name, choices));
      }
      const auto index = static_cast<std::size_t>(found - choices.begin());
      if (std::ranges::find(chosen, index) != chosen.end())
        throw error(key, "\"" + *name + "\" stands twice");
      chosen.push_back(index);
    }
  }
  std::vector<std::string> names;
  for (const std::size_t index : chosen) names.push_back(choices[index]);
  note(key, "[" + list_of(names) + "]");
  return chosen;
}

double TableReader::number_of(std::string_view key, const TomlNode& node, const Range& range) const {
  double value = 0.0;
  if (const auto* whole_number = std::get_if<std::int64_t>(&node.value)) {
    value = static_cast<double>(*whole_number);
  } else if (const auto* number = std::get_if<double>(&node.value)) {
    value = *number;
  } else {
    throw error(key, std::string("must be a number, not ") + kind_name(node));
  }
  // Written so that NaN fails.
  const bool inside = value <= range.high && (range.above_low ? value > range.low : value >= range.low);
  if (!inside) throw error(key, format_double(value) + " is out of range: must be " + describe(range));
  return value;
}

double TableReader::number(std::string_view key, const Range& range, const std::optional<double>& fallback) {
  const TomlNode* node = require(key, fallback.has_value());
  const double value = node != nullptr ? number_of(key, *node, range) : *fallback;
  note(key, format_double(value));
  return value;
}

std::int64_t TableReader::whole(std::string_view key, std::int64_t low, std::int64_t high,
                                const std::optional<std::int64_t>& fallback) {
  const TomlNode* node = require(key, fallback.has_value());
  if (node != nullptr && !std::holds_alternative<std::int64_t>(node->value)) {
    throw error(key, std::string("must be a whole number, not ") + kind_name(*node));
  }
  const std::int64_t value = node != nullptr ? std::get<std::int64_t>(node->value) : *fallback;
  if (value < low || value > high) {
    throw error(key, std::to_string(value) + " is out of range: must be at least " + std::to_string(low) +
                         " and at most " + std::to_string(high));
  }
  note(key, std::to_string(value));
  return value;
}

bool TableReader::flag(std::string_view key, const std::optional<bool>& fallback) {
  const TomlNode* node = require(key, fallback.has_value());
  if (node != nullptr && !std::holds_alternative<bool>(node->value)) {
    throw error(key, std::string("must be true or false, not ") + kind_name(*node));
  }
  const bool value = node != nullptr ? std::get<bool>(node->value) : *fallback;
  note(key, value ? "true" : "false");
  return value;
}

Numbers3 TableReader::numbers_of(std::string_view key, const TomlNode& node, const Range& range) const {
  const auto* items = std::get_if<TomlArray>(&node.value);
  if (items == nullptr)
    throw error(key, std::string("must be a list of three numbers, not ") + kind_name(node));
  if (items->size() != 3) {
    throw error(key, "must be a list of three numbers; it has " + std::to_string(items->size()));
  }
  return {number_of(key, (*items)[0], range), number_of(key, (*items)[1], range),
          number_of(key, (*items)[2], range)};
}

Numbers3 TableReader::numbers(std::string_view key, const Range& range,
                              const std::optional<Numbers3>& fallback) {
  const TomlNode* node = require(key, fallback.has_value());
  const Numbers3 value = node != nullptr ? numbers_of(key, *node, range) : *fallback;
  note(key, format_numbers(value));
  return value;
}

Numbers3 TableReader::numbers_or_one(std::string_view key, const Range& range, const Numbers3& fallback) {
  const TomlNode* node = find(table_, key);
  Numbers3 value = fallback;
  if (node != nullptr && std::holds_alternative<TomlArray>(node->value)) {
    value = numbers_of(key, *node, range);
  } else if (node != nullptr) {
    value.fill(number_of(key, *node, range));
  }
  const bool all_equal = value[0] == value[1] && value[1] == value[2];
  note(key, all_equal ? format_double(value[0]) : format_numbers(value));
  return value;
}

std::vector<double> TableReader::list(std::string_view key, const Range& range, std::size_t most) {
  const TomlNode* node = require(key, false);
  const auto* items = std::get_if<TomlArray>(&node->value);
  if (items == nullptr) throw error(key, std::string("must be a list of numbers, not ") + kind_name(*node));
  if (items->size() > most)
    throw error(key,
                "has " + std::to_string(items->size()) + " numbers; it may have " + std::to_string(most));
  std::vector<double> values;
  std::string text;
  for (const TomlNode& item : *items) {
    values.push_back(number_of(key, item, range));
    text += (text.empty() ? "[" : ", ") + format_double(values.back());
  }
  note(key, text.empty() ? "[]" : text + "]");
  return values;
}

std::string TableReader::any_text(std::string_view key) {
  const TomlNode* node = require(key, false);
  std::string value;
  if (const auto* flag = std::get_if<bool>(&node->value)) {
    value = *flag ? "true" : "false";
  } else if (const auto* whole = std::get_if<std::int64_t>(&node->value)) {
    value = std::to_string(*whole);
  } else if (const auto* number = std::get_if<double>(&node->value)) {
    value = format_double(*number);
  } else if (const auto* text = std::get_if<std::string>(&node->value)) {
    value = *text;
  } else {
    throw error(key, std::string("must be a number, a text or true or false, not ") + kind_name(*node));
  }
  note(key, value);
  return value;
}

const TomlTable& TableReader::table(std::string_view key) const {
  static const TomlTable kEmpty;
  const TomlNode* node = find(table_, key);
  if (node == nullptr) return kEmpty;
  const auto* inner = std::get_if<TomlTable>(&node->value);
  if (inner == nullptr) throw error(key, std::string("must be a table, not ") + kind_name(*node));
  return *inner;
}

void for_each_table(const TableReader& top, const TomlTable& root, const std::string& key, std::size_t most,
                    const std::function<void(const TomlTable& table, int line)>& read_one) {
  const TomlNode* node = find(root, key);
  if (node == nullptr) return;
  const auto* items = std::get_if<TomlArray>(&node->value);
  if (items == nullptr) throw top.error(key, "must be written as [[" + key + "]]");
  if (items->size() > most) {
    throw top.error(key, "stands " + std::to_string(items->size()) + " times; at most " +
                             std::to_string(most) + " are allowed");
  }
  for (const TomlNode& item : *items) {
    const auto* table = std::get_if<TomlTable>(&item.value);
    if (table == nullptr) throw top.error(key, "must be written as [[" + key + "]]");
    read_one(*table, item.line);
  }
}

}  // namespace hallway
