// SPDX-License-Identifier: MIT
#include "editor/complete.hpp"

#include <algorithm>
#include <set>

#include "base/text.hpp"
#include "editor/anchor.hpp"
#include "editor/selection.hpp"
#include "map/sensors.hpp"

namespace hallway::editor {
namespace {

void add_names(const State& state, std::set<std::string>& out) {
  for (const auto& entity : state.entities) {
    if (std::string name = name_of(*entity); !name.empty() && editor::quoted(name) == name)
      out.insert(std::move(name));
  }
}

/// `@NAME.` for all names; once a name is typed, `@NAME.ANCHOR`. Of a list of places the last is completed.
void add_anchors(const State& state, std::string_view typed, std::set<std::string>& out) {
  const std::size_t at = typed.rfind('@');
  if (at == std::string_view::npos || typed.find(',', at) != std::string_view::npos) return;
  const std::string before(typed.substr(0, at + 1));
  std::set<std::string> names;
  add_names(state, names);
  for (const std::string& name : names) {
    if (!typed.substr(at + 1).starts_with(name + ".")) {
      out.insert(before + name + ".");
      continue;
    }
    for (const Anchor& anchor : anchors()) out.insert(before + name + "." + std::string(anchor.name));
  }
}

/// Values that an argument may have. @param typed  what of it is there already
std::set<std::string> values(const State& state, const ArgSpec& spec, std::string_view typed) {
  std::set<std::string> out;
  switch (spec.kind) {
    case ArgKind::kPlace:
    case ArgKind::kPlaces:
      add_anchors(state, typed, out);
      break;
    case ArgKind::kChoice:
      for (const std::string_view choice : split(spec.choices, ' ')) out.emplace(choice);
      break;
    case ArgKind::kWhat:
      add_names(state, out);
      out.insert({"all", "selected"});
      break;
    case ArgKind::kMaterial:
      for (const auto& entity : state.entities) {
        for (const BrushItem& brush : entity->brushes) {
          for (const map::Face& face : brush.brush->faces) {
            if (editor::quoted(face.material) == face.material) out.insert(face.material);
          }
        }
      }
      break;
    default:
      break;
  }
  return out;
}

/// Arguments that the words have given values to, by name.
std::set<std::string_view> given(const CommandSpec& command, const std::vector<std::string>& words) {
  std::set<std::string_view> names;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string_view word = words[i];
    if (const ArgSpec* spec = command.argument(word.substr(0, word.find('=')))) names.insert(spec->name);
  }
  return names;
}

/// The keys that a sensor of the kind in the words may have, of points where there is none.
void add_sensor_keys(const std::vector<std::string>& words, std::set<std::string>& out) {
  constexpr std::string_view kKind = "kind=";
  std::string kind = "points";
  for (const std::string& word : words) {
    if (word.starts_with(kKind)) kind = word.substr(kKind.size());
  }
  if (std::ranges::find(map::sensor_kinds(), kind, &map::SensorKind::name) == map::sensor_kinds().end())
    return;
  for (const std::string& key : map::sensor_key_names(kind)) out.insert(key + "=");
}

void add_arguments(const State& state, const CommandSpec& command, const std::vector<std::string>& words,
                   std::string_view typed, std::set<std::string>& out) {
  const auto names = given(command, words);
  bool first = true;
  for (const ArgSpec& spec : command.arguments) {
    if (names.contains(spec.name)) continue;
    if (spec.kind != ArgKind::kKeys) out.insert(std::string(spec.name) + "=");
    if (first) out.merge(values(state, spec, typed));
    first = false;
  }
  if (command.name == "sensor") add_sensor_keys(words, out);
  if (command.name != "help") return;
  for (const CommandSpec& other : commands()) out.emplace(other.name);
}

}  // namespace

std::vector<std::string> completions(const State& state, const std::vector<std::string>& words,
                                     std::string_view current) {
  std::set<std::string> all;
  std::string prefix;  // of the word, that stays
  if (words.empty()) {
    for (const CommandSpec& command : commands()) all.emplace(command.name);
  } else if (const CommandSpec* command = find_command(words.front())) {
    const std::size_t equals = current.find('=');
    const ArgSpec* named =
        equals == std::string_view::npos ? nullptr : command->argument(current.substr(0, equals));
    const ArgSpec* before = words.size() > 1 ? command->argument(words.back()) : nullptr;
    if (named != nullptr) {
      prefix = current.substr(0, equals + 1);
      all = values(state, *named, current.substr(equals + 1));
    } else if (before != nullptr) {
      all = values(state, *before, current);
    } else {
      add_arguments(state, *command, words, current, all);
    }
  }
  std::vector<std::string> out;
  for (const std::string& candidate : all) {
    if ((prefix + candidate).starts_with(current)) out.push_back(prefix + candidate);
  }
  return out;
}

}  // namespace hallway::editor
