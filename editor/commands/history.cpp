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
#include "base/text.hpp"
#include "editor/commands/topics.hpp"
#include "editor/help.hpp"
#include "editor/selection.hpp"
#include "editor/session.hpp"

namespace hallway::editor {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kCount{ArgSpec{.name = "count",
                                    .kind = ArgKind::kWhole,
                                    .fallback = "1",
                                    .help = "how many steps",
                                    .low = 1,
                                    .high = 1e9}};
constexpr std::array kOptionalCheckpoint{
    ArgSpec{.name = "count", .kind = ArgKind::kWhole, .help = "how many steps [1]", .low = 1, .high = 1e9},
    ArgSpec{.name = "to", .kind = ArgKind::kName, .help = "back to that checkpoint"}};
constexpr std::array kLast{ArgSpec{.name = "last",
                                   .kind = ArgKind::kWhole,
                                   .help = "only so many of the last steps",
                                   .low = 1,
                                   .high = 1e9}};
constexpr std::array kCheckpointName{
    ArgSpec{.name = "name", .kind = ArgKind::kName, .required = true, .help = "what the place is called"}};
constexpr std::array kSince{
    ArgSpec{.name = "since", .kind = ArgKind::kName, .help = "a checkpoint, instead of the last save"}};
constexpr std::array kScript{
    ArgSpec{.name = "file", .kind = ArgKind::kFile, .required = true, .help = "commands, one a line"}};
constexpr std::array kTo{ArgSpec{.name = "to", .kind = ArgKind::kFile, .help = "a new file [the map's]"}};
constexpr std::array kHelpOn{ArgSpec{.name = "command", .kind = ArgKind::kText, .help = "a command's name"}};

void say_steps(const char* verb, const std::vector<std::string>& lines, Report& report) {
  report.data["steps"] = lines;
  if (lines.empty()) report.lines.push_back(fmt::format("nothing to {}", verb));
  for (const std::string& line : lines) report.lines.push_back(fmt::format("{}: {}", verb, printable(line)));
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
  throw Error(ErrorCode::kUsage,
              fmt::format("there is no checkpoint \"{}\"{}", printable(name), suggestion(name, names)));
}

void undo(Session& session, const Arguments& arguments, Report& report) {
  if (arguments.has("to") && arguments.has("count"))
    throw Error(ErrorCode::kUsage, "undo: either `count` or `to`, not both");
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
    const std::string text =
        steps[i].checkpoint.empty() ? steps[i].line : "checkpoint " + steps[i].checkpoint;
    report.data["steps"].push_back({{"number", i + 1}, {"line", text}, {"undone", undone}});
    report.lines.push_back(fmt::format("{:5}{} {}", i + 1, undone ? " (undone)" : "", printable(text, 1000)));
  }
  if (steps.empty()) report.lines.push_back("nothing has been done");
}

void checkpoint(Session& session, const Arguments& arguments, Report& report) {
  session.checkpoint(arguments.text("name"));
  report.data["checkpoint"] = arguments.text("name");
}

/// The things that a patch takes away, changes and adds.
struct Counted {
  std::set<Id> removed, changed, added;
};

void count_entities(const Patch& patch, Counted& counted) {
  std::set<Id> before, after;
  for (const auto& change : patch.entities) {
    for (const auto& entity : change.before) before.insert(entity->id);
    for (const auto& entity : change.after) after.insert(entity->id);
  }
  for (const Id id : before) (after.contains(id) ? counted.changed : counted.removed).insert(id);
  for (const Id id : after) {
    if (!before.contains(id)) counted.added.insert(id);
  }
}

void count_brushes(const EntityChange& change, Counted& counted) {
  if (change.head_after) counted.changed.insert(change.id);
  std::set<Id> before, after;
  for (const auto& splice : change.brushes) {
    for (const BrushItem& brush : splice.before) before.insert(brush.id);
    for (const BrushItem& brush : splice.after) after.insert(brush.id);
  }
  for (const Id id : before) (after.contains(id) ? counted.changed : counted.removed).insert(id);
  for (const Id id : after) {
    if (!before.contains(id)) counted.added.insert(id);
  }
}

void diff(Session& session, const Arguments& arguments, Report& report) {
  State before = session.saved();
  if (arguments.has("since")) {
    before = session.state();
    for (std::size_t i = session.done(); i > place_of(session, arguments.text("since")); --i)
      apply(before, inverse(session.steps()[i - 1].patch));
  }
  const Patch patch = difference(before, session.state());
  Counted counted;
  count_entities(patch, counted);
  for (const EntityChange& change : patch.changes) count_brushes(change, counted);
  const auto list = [&](const char* sign, const char* name, const std::set<Id>& ids, const State& state) {
    report.data[name] = ids;
    for (const Id id : ids) {
      const auto thing = find(state, id);
      if (thing) report.lines.push_back(fmt::format("{} {}", sign, describe(state, *thing)));
    }
  };
  list("-", "removed", counted.removed, before);
  list("~", "changed", counted.changed, session.state());
  list("+", "added", counted.added, session.state());
  if (report.lines.empty()) report.lines.push_back("no difference");
}

void save(Session& session, const Arguments&, Report& report) {
  const bool was_unsaved = session.unsaved();
  session.save();
  report.data["saved"] = was_unsaved;
  report.lines.push_back(was_unsaved ? fmt::format("saved {}", printable(session.file().string()))
                                     : "the file is up to date");
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
    if (std::filesystem::exists(file))
      throw Error(ErrorCode::kIo, "the file is there already", {printable(file), 0, {}});
    write_file_atomically(file, session.text());
    report.lines.push_back(fmt::format("{} has what the journal holds", printable(file)));
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
    if (command == nullptr) {
      std::vector<std::string> names;
      for (const CommandSpec& spec : commands()) names.emplace_back(spec.name);
      throw Error(ErrorCode::kUsage,
                  fmt::format("there is no command \"{}\"{}", printable(name), suggestion(name, names)));
    }
    return say_text(help_text(*command), report);
  }
  say_text(help_overview(), report);
}

constexpr std::array kHistoryCommands{
    CommandSpec{
        .name = "undo",
        .topic = "history",
        .summary = "take back the last steps",
        .details = "Works across shells: the journal beside the map (NAME.map.journal) keeps every step.",
        .arguments = kOptionalCheckpoint,
        .example = "undo 1",
        .before = "checkpoint start",
        .run = &undo},
    CommandSpec{.name = "redo",
                .topic = "history",
                .summary = "do again what was taken back",
                .arguments = kCount,
                .example = "redo",
                .before = "checkpoint start\nundo",
                .run = &redo},
    CommandSpec{.name = "log",
                .topic = "history",
                .summary = "list the steps, undone ones included",
                .arguments = kLast,
                .example = "log last=10",
                .run = &log},
    CommandSpec{.name = "checkpoint",
                .topic = "history",
                .summary = "name this place in the history, for `undo to=NAME`",
                .arguments = kCheckpointName,
                .example = "checkpoint walls-done",
                .run = &checkpoint},
    CommandSpec{.name = "diff",
                .topic = "history",
                .summary = "list what was removed (-), changed (~) and added (+) since the last save",
                .arguments = kSince,
                .example = "diff",
                .run = &diff},
    CommandSpec{.name = "save",
                .topic = "history",
                .summary = "write the map's file",
                .example = "save",
                .run = &save},
    CommandSpec{.name = "recover",
                .topic = "history",
                .summary = "bring the map's file to what the journal holds, after a crash or a loss",
                .details = "With `to` into another file, also from a journal whose end is damaged. An editor "
                           "that was killed needs no "
                           "help: the next one goes on where it was.",
                .arguments = kTo,
                .example = "recover",
                .run = &recover_journal},
    CommandSpec{.name = "source",
                .topic = "history",
                .summary = "run a file of commands as one step: all of them or none",
                .details = "One command a line, as typed or as a JSON object. `#` begins a comment. Paths "
                           "are relative to the script.",
                .arguments = kScript,
                .example = "source house.hwe",
                .run = &source},
    CommandSpec{.name = "help",
                .topic = "history",
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
