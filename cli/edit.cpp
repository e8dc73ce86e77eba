// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "compiled_map.hpp"
#include "console.hpp"
#include "edit_console.hpp"
#include "editor/complete.hpp"
#include "editor/help.hpp"
#include "editor/session.hpp"
#include "output_file.hpp"
#include "renderer_option.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

using editor::Report;
using editor::ScriptLine;
using editor::Session;

struct EditOptions {
  std::string map;
  std::string script;
  std::vector<std::string> words;
  std::optional<std::string> renderer;
  bool keep_going = false;
  bool json = false;
};

constexpr std::uint64_t kMostScriptBytes = 64u << 20;

void show(const Report& report, bool json) {
  if (json) return;
  std::string text;
  for (const std::string& line : report.lines) text += line + "\n";
  print_result(text);
}

void show_notes(const Session& session) {
  for (const std::string& note : session.notes()) print_warning(note);
}

Json json_of(const Report& report) {
  Json json = {{"status", report.status}, {"text", report.lines}};
  json.update(report.data);
  return json;
}

void finish_json(const EditOptions& options, int status, Json reports) {
  if (!options.json) return;
  print_json({{"schema", "hallway.edit/1"},
              {"status", status},
              {"map", path_text(options.map)},
              {"reports", std::move(reports)}});
}

/// Standard input is read to its end.
std::vector<ScriptLine> script_of(const EditOptions& options) {
  if (options.script != "-") return editor::read_script(options.script);
  std::string text;
  for (char block[65536]; std::cin.read(block, sizeof block) || std::cin.gcount() > 0;) {
    text.append(block, static_cast<std::size_t>(std::cin.gcount()));
    if (text.size() > kMostScriptBytes)
      throw Error(ErrorCode::kBadInput, "standard input has more than 64 MiB");
  }
  return editor::script_lines(text, "standard input");
}

int run_whole_script(Session& session, const EditOptions& options) {
  const std::string name =
      options.script == "-" ? "(standard input)" : "source " + editor::quoted(options.script);
  const std::vector<Report> reports = session.run_script(script_of(options), name);
  session.save();
  int status = 0;
  Json list = Json::array();
  for (const Report& report : reports) {
    show(report, options.json);
    list.push_back(json_of(report));
    status = std::max(status, report.status);
  }
  finish_json(options, status, std::move(list));
  return status;
}

/// Each line a step of its own; one that is refused is reported and passed over.
int run_line_by_line(Session& session, const EditOptions& options) {
  int status = 0;
  Json list = Json::array();
  for (const ScriptLine& line : script_of(options)) {
    try {
      const Report report = session.run(editor::parse_script_line(line.text, session.units()));
      show(report, options.json);
      list.push_back(json_of(report));
      status = std::max(status, report.status);
    } catch (const Error& error) {
      if (error.code() == ErrorCode::kInternal) throw;
      const Error placed(error.code(), error.what(), {line.file, line.line, {}});
      if (!options.json) report_failure(placed, false);
      list.push_back({{"status", exit_status(error.code())}, {"error", placed.what()}});
      status = std::max(status, exit_status(error.code()));
    }
  }
  session.save();
  finish_json(options, status, std::move(list));
  return status;
}

int run_one(Session& session, const EditOptions& options) {
  const editor::Call call = editor::parse_words(options.words, session.units());
  const bool from_nothing = session.steps().empty() && !fs::exists(options.map);
  const Report report = session.run(call);
  if (from_nothing && session.steps().empty() && call.command->name != "help")
    print_warning("{} is not there: this is an empty map", path_text(options.map));
  session.save();
  show(report, options.json);
  finish_json(options, report.status, Json::array({json_of(report)}));
  return report.status;
}

/// Needs no readable map, and no whole journal. @return what it came to, in words
std::string recover_map(const EditOptions& options) {
  const editor::Call call = editor::parse_words(options.words, {});
  const std::string to = call.arguments.text_or_empty("to");
  if (to.empty() && fs::exists(options.map)) {
    std::optional<Session> opened;
    try {
      opened.emplace(options.map);  // says why, where the two do not belong together
    } catch (const Error& error) {
      if (error.code() != ErrorCode::kBadInput || !error.where().line) throw;
      throw Error(error.code(), error.message() + "; `recover to=FILE` writes what the journal holds",
                  error.where());
    }
    Session& session = *opened;
    show_notes(session);
    const bool unsaved = session.unsaved();
    session.save();
    return unsaved ? fmt::format("{} has what its journal holds", printable(options.map))
                   : "there is nothing to recover";
  }
  const std::string& file = to.empty() ? options.map : to;
  check_output_file(file);
  if (!to.empty() && fs::exists(to)) throw Error(ErrorCode::kIo, "the file is there already", {to, 0, {}});
  write_file_atomically(file, editor::recover(options.map));
  return fmt::format("{} has what the journal holds", printable(file));
}

/// What the last word may become; the first is the map.
std::vector<std::string> candidates(const std::vector<std::string>& map_and_words) {
  std::vector<std::string> words(map_and_words.begin() + 1, map_and_words.end());
  const std::string current = words.empty() ? std::string() : words.back();
  if (!words.empty()) words.pop_back();
  // No session: completing must not wait for one, nor leave a journal behind.
  editor::State state;
  try {
    state = editor::state_of(load_map(map_and_words.front()));
  } catch (const Error&) {
    // a map to be
  }
  return editor::completions(state, words, current);
}

/// One for all maps and shells of a user; empty where the environment does not say where files of a user are kept.
std::string clipboard_file() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && fs::path(cache).is_absolute())
    return fs::path(cache) / "hallway" / "clipboard.map";
  const char* home = std::getenv("HOME");
  if (home == nullptr || !fs::path(home).is_absolute()) return {};
  return fs::path(home) / ".cache" / "hallway" / "clipboard.map";
}

int edit(EditOptions options) {
  const auto json = std::ranges::find(options.words, "--json");
  if (json != options.words.end()) {
    options.json = true;
    options.words.erase(json);
  }
  if (!options.words.empty() && !options.script.empty())
    refuse("either a command or a script (-f), not both");
  if (!options.words.empty() && options.words[0] == "recover") {
    const Report report{.lines = {recover_map(options)}};
    show(report, options.json);
    finish_json(options, report.status, Json::array({json_of(report)}));
    return report.status;
  }
  if (!fs::path(options.map).has_filename() || fs::is_directory(options.map))
    throw Error(ErrorCode::kUsage, "a map is a file", {printable(options.map), 0, {}});
  const render::Renderer renderer = chosen_renderer(options.renderer);
  Session session(options.map);
  session.set_renderer(renderer);
  session.set_clipboard(clipboard_file());
  show_notes(session);
  if (!options.words.empty()) return run_one(session, options);
  if (!options.script.empty())
    return options.keep_going ? run_line_by_line(session, options) : run_whole_script(session, options);
  if (::isatty(0) != 0) return run_edit_console(session);
  options.script = "-";
  return options.keep_going ? run_line_by_line(session, options) : run_whole_script(session, options);
}

}  // namespace

void add_edit_command(Command& app) {
  Command& command = app.command("edit", "Create and change a map: one command, a script, or a console");
  const auto options = std::make_shared<EditOptions>();
  const auto reference = std::make_shared<bool>(false);
  command.argument("map", &options->map, "A .map file; made where there is none").value("MAP");
  command
      .option("-f,--file", &options->script,
              "Run a file of commands (- for standard input): all of them or none")
      .value("SCRIPT");
  command.flag("--keep-going", &options->keep_going,
               "With -f: each line counts for itself, and one that fails is passed over");
  add_renderer_option(command, options->renderer);
  add_shared(command, Shared::kJson, &options->json);
  command.flag("--reference", reference.get(),
               "Print the table of commands, as docs/edit.md has it; with --json as data");
  command.rest(&options->words);
  command.complete_rest(candidates);
  command.footer(
      "Without a command or script this is a console. `hallway edit MAP help` lists the commands, `help "
      "NAME` explains one.\n"
      "Every step can be undone, also in the next shell: the history is in MAP.journal.\n"
      "Example: hallway edit flat.map new\n"
      "         hallway edit flat.map entity light at 1,2,2.5\n"
      "         hallway edit flat.map undo");
  command.action([options, reference] {
    if (*reference) {
      if (options->json)
        print_json({{"schema", "hallway.edit_commands/1"}, {"commands", editor::reference_json()}});
      else
        print_result(editor::reference_markdown());
      return 0;
    }
    if (options->map.empty()) refuse("which map? `hallway edit --help` says more");
    return edit(*options);
  });
}

}  // namespace hallway::cli
