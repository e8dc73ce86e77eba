// SPDX-License-Identifier: MIT
#include "base/toml_reader.hpp"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "base/toml_ascii.hpp"
#include "base/toml_pieces.hpp"

// toml++ 3.3 or 3.4, header-only, without exceptions, and defined for every ASCII text (toml_ascii.hpp says why no other).

#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#define TOML_MAX_NESTED_VALUES 32  // a scenario needs three, a batch four

// Texts such as `[[[a]]]` break a function's precondition: with assertions the program ends, without them (NDEBUG) clang takes the precondition as given.
// Where it is not checked, the function reports the malformed text as it should.
#define TOML_ASSERT(condition) static_assert(true)
#pragma push_macro("NDEBUG")
#undef NDEBUG
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

namespace hallway {
namespace {

constexpr std::size_t kMaxKeyParts = 16;

int line_of(const toml::source_region& source) {
  return static_cast<int>(source.begin.line);
}

TomlNode convert(const toml::node& node);

TomlArray convert_array(const toml::array& array) {
  TomlArray items;
  items.reserve(array.size());
  for (const toml::node& item : array) items.push_back(convert(item));
  return items;
}

/// toml++ sorts keys by name; a scenario's sensors count in the order of the file.
TomlTable convert_table(const toml::table& table) {
  std::vector<std::pair<const toml::key*, const toml::node*>> pairs;
  for (const auto& [key, node] : table) pairs.emplace_back(&key, &node);
  const auto position = [](const toml::key& key) {
    return std::pair(key.source().begin.line, key.source().begin.column);
  };
  std::ranges::stable_sort(
      pairs, [&](const auto& a, const auto& b) { return position(*a.first) < position(*b.first); });
  TomlTable entries;
  entries.reserve(pairs.size());
  for (const auto& [key, node] : pairs) {
    TomlEntry entry{std::string(key->str()), convert(*node)};
    entry.node.line = line_of(key->source());
    entries.push_back(std::move(entry));
  }
  return entries;
}

TomlNode convert(const toml::node& node) {
  TomlNode copy;
  copy.line = line_of(node.source());
  if (const auto* table = node.as_table()) copy.value = convert_table(*table);
  if (const auto* array = node.as_array()) copy.value = convert_array(*array);
  if (const auto* text = node.as_string()) copy.value = text->get();
  if (const auto* whole = node.as_integer()) copy.value = whole->get();
  if (const auto* number = node.as_floating_point()) copy.value = number->get();
  if (const auto* flag = node.as_boolean()) copy.value = flag->get();
  return copy;
}

void forget_lines(TomlNode& node) {
  node.line = 0;
  if (auto* array = std::get_if<TomlArray>(&node.value)) {
    for (TomlNode& item : *array) forget_lines(item);
  }
  if (auto* table = std::get_if<TomlTable>(&node.value)) {
    for (TomlEntry& entry : *table) forget_lines(entry.node);
  }
}

/// The text as the parser may see it. Throws Error{kBadInput} with the line where the text is malformed.
std::string checked(std::string_view text, const std::string& file) {
  const auto refuse = [&](const std::string& cause, int line) {
    throw Error(ErrorCode::kBadInput, cause, {.file = printable(file), .line = line});
  };
  if (const int line = line_of_deep_key(text, kMaxKeyParts); line > 0)
    refuse("a key has more than " + std::to_string(kMaxKeyParts) + " dotted parts", line);
  auto ascii = ascii_toml(text);
  if (const auto* problem = std::get_if<TomlProblem>(&ascii)) refuse(problem->cause, problem->line);
  return std::get<std::string>(std::move(ascii));
}

}  // namespace

TomlTable parse_toml(std::string_view text, const std::string& file) {
  const toml::parse_result result = toml::parse(checked(text, file), file);
  if (!result) {
    const toml::parse_error& error = result.error();
    throw Error(ErrorCode::kBadInput, printable(error.description()),
                {.file = printable(file), .line = line_of(error.source())});
  }
  return convert_table(result.table());
}

std::optional<TomlNode> parse_toml_value(std::string_view text) {
  if (text.find('\n') != std::string_view::npos) return std::nullopt;  // could smuggle in a second key
  const std::string line = "value = " + std::string(text);
  if (line_of_deep_key(line, kMaxKeyParts) > 0) return std::nullopt;
  const auto ascii = ascii_toml(line);
  if (!std::holds_alternative<std::string>(ascii)) return std::nullopt;
  const toml::parse_result result = toml::parse(std::get<std::string>(ascii));
  if (!result) return std::nullopt;
  TomlTable table = convert_table(result.table());
  forget_lines(table.front().node);
  return std::move(table.front().node);
}

TomlNode toml_value_or_text(const std::string& text) {
  if (auto value = parse_toml_value(text)) return std::move(*value);
  return {.value = text, .line = 0};
}

}  // namespace hallway
