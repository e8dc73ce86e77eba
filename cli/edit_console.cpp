// SPDX-License-Identifier: MIT
#include "edit_console.hpp"

#include <editline/readline.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "console.hpp"
#include "editor/complete.hpp"

namespace hallway::cli {
namespace {

/// libedit's callbacks carry no context of ours.
struct Completing {
  const editor::Session* session = nullptr;
  std::vector<std::string> candidates;
  std::size_t next = 0;
};
Completing completing;

char* next_candidate(const char*, int state) {
  if (state == 0) completing.next = 0;
  if (completing.next == completing.candidates.size()) return nullptr;
  return ::strdup(completing.candidates[completing.next++].c_str());
}

/// The words before the one that begins at `start`; none of a quotation that is open.
std::vector<std::string> words_before(int start) {
  try {
    return editor::words_of(std::string_view(rl_line_buffer).substr(0, static_cast<std::size_t>(start)));
  } catch (const Error&) {
    return {};
  }
}

char** complete(const char* text, int start, int) {
  rl_attempted_completion_over = 1;  // no names of files
  completing.candidates = editor::completions(completing.session->state(), words_before(start), text);
  const bool one = completing.candidates.size() == 1;
  const bool open =
      one && (completing.candidates[0].ends_with('=') || completing.candidates[0].ends_with('.'));
  rl_completion_append_character = open ? '\0' : ' ';
  return rl_completion_matches(text, &next_candidate);
}

void prepare(const editor::Session& session) {
  static char name[] = "hallway";
  static char breaks[] = " \t";
  rl_readline_name = name;
  rl_basic_word_break_characters = breaks;
  rl_completer_word_break_characters = breaks;
  rl_attempted_completion_function = &complete;
  completing.session = &session;
  using_history();
  for (const editor::Step& step : session.steps()) {
    if (!step.line.empty()) add_history(step.line.c_str());
  }
}

void run_line(editor::Session& session, const std::string& line) {
  try {
    const editor::Report report = session.run(editor::parse_script_line(line, session.units()));
    std::string text;
    for (const std::string& one : report.lines) text += one + "\n";
    print_result(text);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kInternal) throw;
    fmt::print(stderr, "{}\n", error.what());
  }
}

}  // namespace

int run_edit_console(editor::Session& session) {
  prepare(session);
  const std::string name = printable(session.file().filename().string());
  print_result(
      "Editing {}. `help` lists the commands, `help NAME` explains one, TAB completes; `quit` or "
      "Ctrl-D leaves.\n",
      name);
  for (;;) {
    const std::string prompt = fmt::format("{}{}> ", name, session.unsaved() ? " (unsaved)" : "");
    const std::unique_ptr<char, decltype(&std::free)> typed(::readline(prompt.c_str()), &std::free);
    if (typed == nullptr) break;
    const std::string line(trim(typed.get()));
    if (line.empty()) continue;
    add_history(line.c_str());
    if (line == "quit" || line == "exit") break;
    run_line(session, line);
  }
  print_result(
      session.unsaved()
          ? fmt::format("{} is not saved. {}.journal keeps the changes, and the next session continues from "
                        "here; `hallway edit {} save` writes the map.\n",
                        name, name, name)
          : fmt::format("{} is saved.\n", name));
  return 0;
}

}  // namespace hallway::cli
