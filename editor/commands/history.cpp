// SPDX-License-Identifier: MIT
//
// Commands about the session: what has been done, and what of it counts.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/commands/topics.hpp"
#include "editor/help.hpp"
#include "editor/history_script.hpp"
#include "editor/selection.hpp"
#include "editor/session.hpp"

namespace hallway::editor {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kCount{ArgSpec{"count", ArgKind::kWhole, "how many steps", "1"}.within(1, 1e9)};
constexpr std::array kOptionalCheckpoint{
    ArgSpec{"count", ArgKind::kWhole, "how many steps [1]"}.within(1, 1e9),
    ArgSpec{"to", ArgKind::kName, "back to that checkpoint"}};
constexpr std::array kLast{ArgSpec{"last", ArgKind::kWhole, "only so many of the last steps"}.within(1, 1e9)};
constexpr std::array kCheckpointName{ArgSpec{"name", ArgKind::kName, "what the place is called"}.needed()};
constexpr std::array kSince{ArgSpec{"since", ArgKind::kName, "a checkpoint, instead of the last save"}};
constexpr std::array kScript{ArgSpec{"file", ArgKind::kFile, "commands, one a line"}.needed()};
constexpr std::array kTo{ArgSpec{"to", ArgKind::kFile, "a new file [the map's]"}};
constexpr std::array kHistory{ArgSpec{"action", ArgKind::kChoice, "save: as a script", "", "save"}.needed(),
                              ArgSpec{"file", ArgKind::kFile, "a new file"}.needed()};
constexpr std::array kHelpOn{ArgSpec{"command", ArgKind::kText, "a command's name"}};

void say_steps(const char* verb, const std::vector<std::string>& lines, Report& report) {
  report.data["steps"] = lines;
  if (lines.empty()) report.say("nothing to {}", verb);
  for (const std::string& line : lines) report.say("{}: {}", verb, printable(line));
}

/// The number of steps that stand before the last checkpoint of that name among the first `done`.
std::size_t place_of(const Session& session, const std::string& name) {
  const auto& steps = session.steps();
  for (std::size_t i = session.done(); i-- > 0;) {
    if (steps[i].checkpoint == name) return i + 1;
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < session.done(); ++i) {
    if (!steps[i].checkpoint.empty()) names.push_back(steps[i].checkpoint);
  }
  refuse("there is no checkpoint \"{}\"{}", printable(name), suggestion(name, names));
}

void undo(Session& session, const Arguments& arguments, Report& report) {
  if (arguments.has("to") && arguments.has("count")) refuse("undo: either `count` or `to`, not both");
  std::size_t count = arguments.has("count") ? static_cast<std::size_t>(arguments.whole("count")) : 1;
  if (arguments.has("to")) count = session.done() - place_of(session, arguments.text("to"));
  say_steps("undo", session.undo(count), report);
}

void redo(Session& session, const Arguments& arguments, Report& report) {
  say_steps("redo", session.redo(static_cast<std::size_t>(arguments.whole("count"))), report);
}

void log(Session& session, const Arguments& arguments, Report& report) {
  const auto& steps = session.steps();
  std::size_t first = 0;
  if (arguments.has("last"))
    first = steps.size() - std::min(steps.size(), static_cast<std::size_t>(arguments.whole("last")));
  report.data["steps"] = Json::array();
  for (std::size_t i = first; i < steps.size(); ++i) {
    const bool undone = i >= session.done();
    const std::string text = steps[i].text();
    report.data["steps"].push_back({{"number", i + 1}, {"line", text}, {"undone", undone}});
    report.say("{:5}{} {}", i + 1, undone ? " (undone)" : "", printable(text, 1000));
  }
  if (steps.empty()) report.say("nothing has been done");
}

void checkpoint(Session& session, const Arguments& arguments, Report& report) {
  session.checkpoint(arguments.text("name"));
  report.data["checkpoint"] = arguments.text("name");
}

/// The things that a patch takes away, changes and adds.
struct Counted {
  std::set<Id> removed, changed, added;
};

void count(const std::set<Id>& before, const std::set<Id>& after, Counted& counted) {
  for (const Id id : before) (after.contains(id) ? counted.changed : counted.removed).insert(id);
  std::ranges::set_difference(after, before, std::inserter(counted.added, counted.added.end()));
}

Counted counted_in(const Patch& patch) {
  Counted counted;
  std::set<Id> before, after;
  for (const auto& change : patch.entities) {
    for (const auto& entity : change.before) before.insert(entity->id);
    for (const auto& entity : change.after) after.insert(entity->id);
  }
  count(before, after, counted);
  for (const EntityChange& change : patch.changes) {
    if (change.head_after) counted.changed.insert(change.id);
    before.clear();
    after.clear();
    for (const auto& splice : change.brushes) {
      for (const BrushItem& brush : splice.before) before.insert(brush.id);
      for (const BrushItem& brush : splice.after) after.insert(brush.id);
    }
    count(before, after, counted);
  }
  return counted;
}

void diff(Session& session, const Arguments& arguments, Report& report) {
  State before = session.saved();
  if (arguments.has("since")) {
    before = session.state();
    for (std::size_t i = session.done(); i > place_of(session, arguments.text("since")); --i)
      apply(before, inverse(session.steps()[i - 1].patch));
  }
  const Counted counted = counted_in(difference(before, session.state()));
  const auto list = [&](const char* sign, const char* name, const std::set<Id>& ids, const State& state) {
    report.data[name] = ids;
    for (const Id id : ids) {
      const auto thing = find(state, id);
      if (thing) report.say("{} {}", sign, describe(state, *thing));
    }
  };
  list("-", "removed", counted.removed, before);
  list("~", "changed", counted.changed, session.state());
  list("+", "added", counted.added, session.state());
  if (report.lines.empty()) report.say("no difference");
}

void save(Session& session, const Arguments&, Report& report) {
  const bool was_unsaved = session.unsaved();
  session.save();
  report.data["saved"] = was_unsaved;
  report.say(was_unsaved ? fmt::format("saved {}", printable(session.file().string()))
                         : "the file is up to date");
}

void check_new_file(const std::string& file) {
  if (std::filesystem::exists(file))
    throw Error(ErrorCode::kIo, "the file is there already", {printable(file), 0, {}});
}

void save_history(Session& session, const Arguments& arguments, Report& report) {
  const std::string& file = arguments.text("file");
  check_new_file(file);
  const std::string script = history_script(session);
  write_file_atomically(file, script);
  const auto lines = std::ranges::count(script, '\n');
  report.data["file"] = file;
  report.say("wrote {} lines to {}", lines, printable(file));
}

void source(Session& session, const Arguments& arguments, Report& report) {
  const std::string& file = arguments.text("file");
  const auto reports = session.run_script(read_script(file), "source " + quoted(file));
  for (const Report& one : reports) {
    report.lines.insert(report.lines.end(), one.lines.begin(), one.lines.end());
    report.status = std::max(report.status, one.status);
  }
  report.data["commands"] = reports.size();
}

void recover_journal(Session& session, const Arguments& arguments, Report& report) {
  // The one-shot form, which needs no readable map, is the program's; in a session the journal has been read already.
  if (arguments.has("to")) {
    const std::string& file = arguments.text("to");
    check_new_file(file);
    write_file_atomically(file, session.text());
    report.say("{} has what the journal holds", printable(file));
  } else {
    save(session, arguments, report);
  }
}

void say_text(const std::string& text, Report& report) {
  for (const std::string_view line : split(text, '\n')) report.lines.emplace_back(line);
}

void help(Session&, const Arguments& arguments, Report& report) {
  if (arguments.has("command")) {
    const std::string& name = arguments.text("command");
    const CommandSpec* command = find_command(name);
    if (command == nullptr)
      refuse("there is no command \"{}\"{}", printable(name),
             suggestion(name, names_in(commands(), &CommandSpec::name)));
    return say_text(help_text(*command), report);
  }
  say_text(help_overview(), report);
}

constexpr std::array kHistoryCommands{
    CommandSpec{
        .name = "undo",
        .summary = "take back the last steps",
        .details = "Works across shells: the journal beside the map (NAME.map.journal) keeps every step.",
        .arguments = kOptionalCheckpoint,
        .example = "undo 1",
        .before = "checkpoint start",
        .run = &undo},
    CommandSpec{.name = "redo",
                .summary = "do again what was taken back",
                .arguments = kCount,
                .example = "redo",
                .before = "checkpoint start\nundo",
                .run = &redo},
    CommandSpec{.name = "log",
                .summary = "list the steps, undone ones included",
                .arguments = kLast,
                .example = "log last=10",
                .run = &log},
    CommandSpec{.name = "history",
                .summary = "save the steps that count as a script",
                .details = "On an empty map, or on the map that the history began with, `hallway edit MAP -f "
                           "FILE` then makes the same map, byte for byte. Steps that were undone are left "
                           "out. Every line is tried first; a step that cannot be repeated, such as `paste`, "
                           "is named and nothing is written.",
                .arguments = kHistory,
                .example = "history save steps.hwe",
                .before = "wall from 0,0 to 6,0 name=north",
                .run = &save_history},
    CommandSpec{.name = "checkpoint",
                .summary = "name this place in the history, for `undo to=NAME`",
                .arguments = kCheckpointName,
                .example = "checkpoint walls-done",
                .run = &checkpoint},
    CommandSpec{.name = "diff",
                .summary = "list what was removed (-), changed (~) and added (+) since the last save",
                .arguments = kSince,
                .example = "diff",
                .run = &diff},
    CommandSpec{.name = "save", .summary = "write the map's file", .example = "save", .run = &save},
    CommandSpec{.name = "recover",
                .summary = "bring the map's file to what the journal holds, after a crash or a loss",
                .details = "With `to` into another file, also from a journal whose end is damaged. An editor "
                           "that was killed needs no "
                           "help: the next one goes on where it was.",
                .arguments = kTo,
                .example = "recover",
                .run = &recover_journal},
    CommandSpec{.name = "source",
                .summary = "run a file of commands as one step: all of them or none",
                .details = "One command a line, as typed or as a JSON object. `#` begins a comment. Paths "
                           "are relative to the script.",
                .arguments = kScript,
                .example = "source house.hwe",
                .run = &source},
    CommandSpec{.name = "help",
                .summary = "list commands, or explain one",
                .arguments = kHelpOn,
                .example = "help undo",
                .run = &help},
};

}  // namespace

std::span<const CommandSpec> history_commands() {
  return kHistoryCommands;
}

}  // namespace hallway::editor
