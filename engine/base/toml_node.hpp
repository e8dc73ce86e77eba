// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hallway {

struct TomlNode;
struct TomlEntry;

using TomlArray = std::vector<TomlNode>;
/// Key-value pairs in the order of the file; no key stands twice.
using TomlTable = std::vector<TomlEntry>;

/// A date or a time: TOML has them, our files do not use them.
struct TomlDate {};

/// A value and where it came from.
struct TomlNode {
  std::variant<TomlDate, bool, std::int64_t, double, std::string, TomlArray, TomlTable> value;
  int line = 0;        ///< 1-based line in the file; 0 for what the command line gave
  std::string file{};  ///< set: another file gave it than the one that the document was read from
};

/// One `key = value` or `[key]`.
struct TomlEntry {
  std::string key;
  TomlNode node;
};

/// The value of `key`, or null. O(number of keys).
const TomlNode* find(const TomlTable& table, std::string_view key);
TomlNode* find(TomlTable& table, std::string_view key);

/// Gives `key` a value, in the place where it has one already, else at the end.
void assign(TomlTable& table, std::string_view key, TomlNode value);

/// The table `key`, made where it is missing; null where something else stands there.
TomlTable* table_in(TomlTable& parent, std::string_view key);

/// The keys of a table, in their order.
std::vector<std::string> keys_of(const TomlTable& table);

/// What kind of value it is, for messages: "a number", "a table", …
const char* kind_name(const TomlNode& node);

}  // namespace hallway
