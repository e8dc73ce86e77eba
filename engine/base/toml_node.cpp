// SPDX-License-Identifier: MIT
#include "base/toml_node.hpp"

#include <algorithm>
#include <utility>

namespace hallway {

TomlNode* find(TomlTable& table, std::string_view key) {
  const auto found = std::ranges::find_if(table, [&](const TomlEntry& entry) { return entry.key == key; });
  return found == table.end() ? nullptr : &found->node;
}

const TomlNode* find(const TomlTable& table, std::string_view key) {
  const auto found = std::ranges::find_if(table, [&](const TomlEntry& entry) { return entry.key == key; });
  return found == table.end() ? nullptr : &found->node;
}

void assign(TomlTable& table, std::string_view key, TomlNode value) {
  if (TomlNode* node = find(table, key)) {
    *node = std::move(value);
  } else {
    table.push_back({std::string(key), std::move(value)});
  }
}

TomlTable* table_in(TomlTable& parent, std::string_view key) {
  if (find(parent, key) == nullptr) parent.push_back({std::string(key), {.value = TomlTable{}, .line = 0}});
  return std::get_if<TomlTable>(&find(parent, key)->value);
}

std::vector<std::string> keys_of(const TomlTable& table) {
  std::vector<std::string> keys;
  for (const TomlEntry& entry : table) keys.push_back(entry.key);
  return keys;
}

const char* kind_name(const TomlNode& node) {
  struct Names {
    const char* operator()(const TomlDate&) const { return "a date or time"; }
    const char* operator()(bool) const { return "true or false"; }
    const char* operator()(std::int64_t) const { return "a whole number"; }
    const char* operator()(double) const { return "a number with a fraction"; }
    const char* operator()(const std::string&) const { return "a text"; }
    const char* operator()(const TomlArray&) const { return "a list"; }
    const char* operator()(const TomlTable&) const { return "a table"; }
  };
  return std::visit(Names{}, node.value);
}

}  // namespace hallway
