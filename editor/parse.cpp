// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <utility>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/command.hpp"

namespace hallway::editor {
namespace {

using Json = nlohmann::ordered_json;

const CommandSpec& known_command(const std::string& name) {
  if (const CommandSpec* command = find_command(name)) return *command;
  refuse("there is no command \"{}\"{}; `help` lists them", printable(name),
         suggestion(name, names_in(commands(), &CommandSpec::name)));
}

/// Collects the values of one call.
class Reader {
 public:
  Reader(const CommandSpec& command, const Units& units) : command_(command), units_(units) {
    call_.command = &command;
  }

  const ArgSpec* find(std::string_view name) const { return command_.argument(name); }

  bool is_given(const ArgSpec& spec) const { return given_.contains(spec.name); }

  /// The first argument that nothing has been given for.
  const ArgSpec* next() const {
    for (const ArgSpec& spec : command_.arguments) {
      if (!is_given(spec) || spec.kind == ArgKind::kKeys) return &spec;
    }
    return nullptr;
  }

  /// The argument that any `key=value` is for, where a WHAT=... is not expected first.
  const ArgSpec* takes_keys() const {
    const ArgSpec* first = next();
    if (first != nullptr && first->kind == ArgKind::kWhat) return nullptr;
    const auto keys = std::ranges::find(command_.arguments, ArgKind::kKeys, &ArgSpec::kind);
    return keys == command_.arguments.end() ? nullptr : &*keys;
  }

  void give(const ArgSpec& spec, std::string_view word) {
    Value value = read_value(spec, word, units_);
    if (spec.kind == ArgKind::kKeys) {
      Pairs keys = is_given(spec) ? call_.arguments.keys(spec.name) : Pairs{};
      std::ranges::move(std::get<Pairs>(value), std::back_inserter(keys));
      value = std::move(keys);
    } else if (is_given(spec)) {
      refuse("{}: `{}` is given twice", command_.name, spec.name);
    }
    given_.insert(spec.name);
    call_.arguments.set(spec.name, std::move(value));
  }

  Call finish(std::string line) {
    for (const ArgSpec& spec : command_.arguments) {
      if (is_given(spec)) continue;
      if (spec.required) {
        refuse("{}: `{}` ({}) is missing; `help {}` shows what it takes", command_.name, spec.name,
               type_name(spec), command_.name);
      }
      if (!spec.fallback.empty()) call_.arguments.set(spec.name, read_value(spec, spec.fallback, units_));
    }
    call_.line = std::move(line);
    return std::move(call_);
  }

  [[noreturn]] void unknown(std::string_view name) const {
    const auto names = names_in(command_.arguments, &ArgSpec::name);
    if (names.empty()) refuse("{}: takes no argument, and there is \"{}\"", command_.name, printable(name));
    refuse("{}: there is no argument \"{}\"{}; it takes: {}", command_.name, printable(name),
           suggestion(name, names), fmt::join(names, ", "));
  }

 private:
  const CommandSpec& command_;
  const Units& units_;
  std::set<std::string_view> given_;
  Call call_;
};

/// The argument that a word like `height=2.7` is for, if it is for one.
const ArgSpec* named_in(const Reader& reader, std::string_view word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string_view::npos) return nullptr;
  return reader.find(word.substr(0, equals));
}

std::string join(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + quoted(word);
  return line;
}

/// What a JSON value would be if it were typed.
std::string word_of(const ArgSpec& spec, const Json& json) {
  const auto text = [](const Json& value) -> std::string {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number()) return value.is_number_float() ? format_double(value.get<double>()) : value.dump();
    if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
    refuse("an argument in JSON is neither a text nor a number nor a list of them");
  };
  const auto list = [&](const Json& values) {
    std::string word;
    for (const Json& value : values) word += (word.empty() ? "" : ",") + text(value);
    return word;
  };
  if (!json.is_array()) return text(json);
  if (spec.kind != ArgKind::kPlaces) return list(json);
  std::string word;
  for (const Json& place : json)
    word += (word.empty() ? "" : ";") + (place.is_array() ? list(place) : text(place));
  return word;
}

}  // namespace

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  std::size_t at = 0;
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (at < line.size()) {
    if (is_blank(line[at])) {
      ++at;
      continue;
    }
    const bool number_follows = at + 1 < line.size() && line[at + 1] >= '0' && line[at + 1] <= '9';
    if (line[at] == '#' && !number_follows) break;
    std::string word;
    bool inside = false;
    for (; at < line.size() && (inside || !is_blank(line[at])); ++at) {
      const char next = at + 1 < line.size() ? line[at + 1] : '\0';
      if (line[at] == '\\' && (next == '"' || (inside && next == '\\'))) {
        word += line[++at];
      } else if (line[at] == '"') {
        inside = !inside;
      } else {
        word += line[at];
      }
    }
    if (inside) refuse("a quotation (\") does not end");
    words.push_back(std::move(word));
  }
  return words;
}

std::string quoted(const std::string& word) {
  constexpr std::string_view kSpecial = " \t\r\"";
  const bool number_sign = word.starts_with('#') && !(word.size() > 1 && word[1] >= '0' && word[1] <= '9');
  if (!word.empty() && !number_sign && word.find_first_of(kSpecial) == std::string::npos) return word;
  // Of `key=value` only the value, which reads better.
  const std::size_t equals = word.find('=');
  const bool value_only =
      !number_sign && equals != std::string::npos && word.find_first_of(kSpecial) > equals;
  const std::size_t begin = value_only ? equals + 1 : 0;
  std::string out = word.substr(0, begin) + '"';
  for (const char c : std::string_view(word).substr(begin)) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

Call parse_words(const std::vector<std::string>& words, const Units& units) {
  if (words.empty()) return {};
  Reader reader(known_command(words[0]), units);
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (const ArgSpec* named = named_in(reader, word)) {
      reader.give(*named, std::string_view(word).substr(named->name.size() + 1));
      continue;
    }
    const ArgSpec* named = reader.find(word);
    if (named != nullptr && !reader.is_given(*named) && i + 1 < words.size()) {
      reader.give(*named, words[++i]);
      continue;
    }
    // `key=value` that no argument has is for those that take any key.
    const std::size_t equals = word.find('=');
    const ArgSpec* next = equals == std::string::npos ? nullptr : reader.takes_keys();
    if (next == nullptr) next = reader.next();
    const bool is_free = next != nullptr && (next->kind == ArgKind::kKeys || next->kind == ArgKind::kWhat ||
                                             next->kind == ArgKind::kText);
    if (next == nullptr || (equals != std::string::npos && !is_free))
      reader.unknown(std::string_view(word).substr(0, equals));
    reader.give(*next, word);
  }
  return reader.finish(join(words));
}

Call parse_line(std::string_view line, const Units& units) {
  return parse_words(words_of(line), units);
}

Call parse_json(const Json& json, const Units& units) {
  if (!json.is_object()) refuse("a command in JSON is an object: {\"command\": NAME, ARGUMENT: VALUE, ...}");
  if (!json.contains("command") || !json["command"].is_string())
    refuse("a command in JSON has no \"command\"");
  std::vector<std::string> words{json["command"].get<std::string>()};
  Reader reader(known_command(words[0]), units);
  for (const auto& [name, value] : json.items()) {
    if (name == "command") continue;
    const ArgSpec* spec = reader.find(name);
    if (spec == nullptr) reader.unknown(name);
    if (spec->kind == ArgKind::kKeys) {
      if (!value.is_object()) refuse("{}: {} is no object of keys and values", words[0], name);
      for (const auto& [key, text] : value.items()) {
        words.push_back(key + "=" + word_of(*spec, text));
        reader.give(*spec, words.back());
      }
      continue;
    }
    const std::string word = word_of(*spec, value);
    reader.give(*spec, word);
    words.push_back(name + "=" + word);
  }
  return reader.finish(join(words));
}

Call parse_script_line(std::string_view line, const Units& units) {
  const std::string_view text = trim(line);
  if (!text.starts_with('{')) return parse_line(text, units);
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) refuse("a line that begins with { is not one JSON object");
  return parse_json(json, units);
}

}  // namespace hallway::editor
