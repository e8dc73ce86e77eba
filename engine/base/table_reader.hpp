// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/setting.hpp"
#include "base/toml_node.hpp"

namespace hallway {

/// The numbers that a setting may have.
struct Range {
  double low = 0.0;
  double high = 0.0;
  bool above_low = false;  ///< `low` itself is refused
};

using Numbers3 = std::array<double, 3>;

/// Reads the keys of one table of a TOML file as what they mean, and notes every effective setting with its origin.
///
/// Each getter throws Error{kBadInput} (Error{kUsage} for what the command line gave) with file, line and key if the value
/// is of another kind or out of range, or if the key is missing and there is no default.
class TableReader {
 public:
  /// @param file    the file as the user named it
  /// @param prefix  name of the table for messages and settings, e.g. "sensor.eyes"; empty for the top
  /// @param known   the keys that the table may have; any other one throws, with a suggestion
  /// @param line    of the table, for what is missing in it
  /// `table` and `settings` must outlive this.
  TableReader(std::string file, std::string prefix, const TomlTable& table, int line,
              const std::vector<std::string>& known, std::vector<Setting>& settings);

  bool has(std::string_view key) const { return find(table_, key) != nullptr; }

  std::string text(std::string_view key, const std::optional<std::string>& fallback = std::nullopt);
  /// One of `choices`; gives its index.
  std::size_t choice(std::string_view key, const std::vector<std::string>& choices,
                     const std::optional<std::size_t>& fallback = std::nullopt);
  /// A list of some of `choices`, none twice; gives their indices. Default: all.
  std::vector<std::size_t> choices(std::string_view key, const std::vector<std::string>& choices);
  double number(std::string_view key, const Range& range,
                const std::optional<double>& fallback = std::nullopt);
  std::int64_t whole(std::string_view key, std::int64_t low, std::int64_t high,
                     const std::optional<std::int64_t>& fallback = std::nullopt);
  bool flag(std::string_view key, const std::optional<bool>& fallback = std::nullopt);
  /// A list of three numbers.
  Numbers3 numbers(std::string_view key, const Range& range,
                   const std::optional<Numbers3>& fallback = std::nullopt);
  /// A list of three numbers, or one number for all three.
  Numbers3 numbers_or_one(std::string_view key, const Range& range, const Numbers3& fallback);
  /// A list of at most `most` numbers.
  std::vector<double> list(std::string_view key, const Range& range, std::size_t most);
  /// A number, a text or a truth value, as text.
  std::string any_text(std::string_view key);

  /// The sub-table `key`, empty where there is none.
  const TomlTable& table(std::string_view key) const;
  /// The line of a key, of the table itself where it is missing, 0 for what the command line gave.
  int line(std::string_view key) const;
  /// The file that gave a key; the table's own where it is missing.
  const std::string& file(std::string_view key) const;
  /// Where the value of a key stands: "office.toml:12", "default" or "command line".
  std::string origin(std::string_view key) const;
  /// The key with the table's name before it.
  std::string full_key(std::string_view key) const;
  /// An Error about this key.
  Error error(std::string_view key, const std::string& message) const;

 private:
  const TomlNode* require(std::string_view key, bool has_fallback) const;
  double number_of(std::string_view key, const TomlNode& node, const Range& range) const;
  Numbers3 numbers_of(std::string_view key, const TomlNode& node, const Range& range) const;
  void note(std::string_view key, std::string value);

  std::string file_;
  std::string prefix_;
  const TomlTable& table_;
  int line_;
  std::vector<Setting>& settings_;
};

/// Calls `read_one` with every table of the list of tables `key` of `root`, and its line. Throws Error{kBadInput} where something else stands
/// there, or more than `most`.
/// @param top  reads `root`
void for_each_table(const TableReader& top, const TomlTable& root, const std::string& key, std::size_t most,
                    const std::function<void(const TomlTable& table, int line)>& read_one);

/// "[1, 2.5, 3]".
std::string format_numbers(const Numbers3& numbers);

}  // namespace hallway
