// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "editor/arguments.hpp"
#include "editor/state.hpp"
#include "render/renderer.hpp"

namespace hallway::editor {

class Session;

/// What a command says when it is done.
struct Report {
  std::vector<std::string> lines{};                                ///< for people, safe to print
  nlohmann::ordered_json data = nlohmann::ordered_json::object();  ///< the same for programs
  int status = 0;  ///< 1 where the command ran and its answer is no (a leak, a finding)

  /// Adds a line.
  void say(std::string line) { lines.push_back(std::move(line)); }
  template <typename First, typename... Rest>
  void say(fmt::format_string<First, Rest...> format, First&& first, Rest&&... rest) {
    say(fmt::format(format, std::forward<First>(first), std::forward<Rest>(rest)...));
  }
  /// Adds a line about something that the user may not expect; programs find it under "notes".
  void note(const std::string& text);
};

/// How a map's lengths are read that are typed in map units: by `_scale` of worldspawn, Quake's where that is absent or wrong.
Units units_of(const State& state);

/// A command at work on a map: a state of its own, which counts only if the command returns.
struct Edit {
  State state;
  std::string file;  ///< the map's path, for messages and for what commands look up beside it
  Report report{};
  std::string clipboard{};  ///< file that `copy` writes and `paste` reads; empty: there is none
  render::Renderer renderer = render::Renderer::kAuto;  ///< of pictures
  std::string* held_clipboard = nullptr;  ///< instead of the file, where commands are only tried; not owned

  double metres_per_unit() const;
  /// Places of points in the map, rounded to the grid if there is one; metres to map units.
  Vec3 units(const Vec3& place_m) const;
};

/// A map to work on that rounds no place to a grid.
Edit without_grid(const State& state, const std::string& file = {});

/// A command that changes or looks at a map and nothing else. Throws Error{kUsage, kBadInput} to refuse; nothing has happened then.
using EditFunction = void (*)(Edit& edit, const Arguments& arguments);
/// A command about the session itself: its history, its files.
using SessionFunction = void (*)(Session& session, const Arguments& arguments, Report& report);

/// A command, as data. Parser, `help`, completion, docs/edit.md and the JSON form are made from it.
struct CommandSpec {
  std::string_view name{};
  std::string_view summary{};  ///< one line
  std::string_view details{};  ///< paragraphs for `help NAME`; may be empty
  std::span<const ArgSpec> arguments{};
  /// A line that works in a new map after the lines of `before`.
  std::string_view example{};
  std::string_view before{};  ///< lines that the example needs, with line ends between them
  std::variant<EditFunction, SessionFunction> run{};
  std::string_view topic{};  ///< heading in lists of commands; commands() sets it

  /// The argument of that name, or null.
  const ArgSpec* argument(std::string_view argument_name) const;
};

/// All commands, by topic in the order in which one meets them.
std::span<const CommandSpec> commands();

/// The command of that name, or null.
const CommandSpec* find_command(std::string_view name);

/// A command to be run, and how it was said.
struct Call {
  const CommandSpec* command = nullptr;
  Arguments arguments{};
  std::string line{};  ///< as it would be typed
};

/// Reads a line: the command's name, then arguments. An argument is `name value`, `name=value`, or just the value where it is the
/// first in the command's list that has none yet. Quotes ("…") keep blanks together, `\"` stands for a quotation mark and within quotes `\\` for a backslash, `#` at the
/// start of a word begins a comment unless a number follows. An empty line, or one of comment only, gives a Call without a command.
///
/// Throws Error{kUsage} with the nearest known name for what it does not know.
Call parse_line(std::string_view line, const Units& units);

/// A line of a script: as parse_line() reads it, or one JSON object as parse_json() does.
Call parse_script_line(std::string_view line, const Units& units);

/// The same from words, as a shell hands them over.
Call parse_words(const std::vector<std::string>& words, const Units& units);

/// The same from one JSON object: `{"command": "wall", "from": [0, 0], "to": [6, 0], "height": 2.7}`. Numbers, texts, lists of numbers
/// for places, lists of those for `kPlaces`, objects for `kKeys`; a text is read as if it had been typed.
Call parse_json(const nlohmann::ordered_json& json, const Units& units);

/// The words of a line without its comment. Throws Error{kUsage} for a quotation that does not end.
std::vector<std::string> words_of(std::string_view line);

/// A word as it has to be typed so that words_of() gives it back.
std::string quoted(const std::string& word);

}  // namespace hallway::editor
