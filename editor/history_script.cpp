// SPDX-License-Identifier: MIT
#include "editor/history_script.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/made_line.hpp"
#include "map/writer.hpp"

namespace hallway::editor {
namespace {

/// Numbers in the history, and those of the same things when the script runs. They differ where steps were undone, or another program
/// changed the map: numbers are never given twice.
using Numbers = std::map<Id, Id>;

/// Adds things at the same place in both states. False where their shapes differ.
bool pair_up(const State& history, const State& script, Numbers& numbers) {
  if (history.entities.size() != script.entities.size()) return false;
  for (std::size_t e = 0; e < history.entities.size(); ++e) {
    const EntityItem& a = *history.entities[e];
    const EntityItem& b = *script.entities[e];
    if (a.brushes.size() != b.brushes.size()) return false;
    numbers[a.id] = b.id;
    for (std::size_t i = 0; i < a.brushes.size(); ++i) numbers[a.brushes[i].id] = b.brushes[i].id;
  }
  return true;
}

std::string with_numbers(std::string_view term, const Numbers& numbers) {
  const std::string_view digits = term.starts_with('#') ? term.substr(1) : term;
  const std::size_t dots = digits.find("..");
  const auto first = parse_uint(digits.substr(0, dots));
  const auto last = dots == std::string_view::npos ? first : parse_uint(digits.substr(dots + 2));
  if (!first || !last) return std::string(term);
  std::string terms;
  for (auto at = numbers.lower_bound(*first); at != numbers.end() && at->first <= *last; ++at)
    terms += (terms.empty() ? "#" : "+#") + std::to_string(at->second);
  return terms.empty() ? std::string(term) : terms;
}

bool are_same(const Numbers& numbers) {
  for (const auto& [before, now] : numbers) {
    if (before != now) return false;
  }
  return true;
}

/// The call with the numbers that its things have now.
Call renumbered(const Call& call, const Numbers& numbers) {
  Call next = call;
  bool any = false;
  for (const ArgSpec& spec : call.command->arguments) {
    if (spec.kind != ArgKind::kWhat || !call.arguments.has(spec.name)) continue;
    std::string what;
    for (const std::string_view term : split(call.arguments.text(spec.name), '+'))
      what += (what.empty() ? "" : "+") + with_numbers(trim(term), numbers);
    any = any || what != call.arguments.text(spec.name);
    next.arguments.set(spec.name, std::move(what));
  }
  if (any) next.line = line_of(*call.command, next.arguments);
  return next;
}

/// Writes lines, each of which has been run.
class Writer {
 public:
  Writer(const State& before, const std::string& file) : history_(before) {
    replay_.state = state_of(document_of(before, file));
    replay_.file = file;
    replay_.held_clipboard = &clipboard_;
    pair_up(history_, replay_.state, numbers_);
  }

  void add(const Step& step) {
    if (!step.checkpoint.empty()) {
      text_ += "# checkpoint " + printable(step.checkpoint) + "\n";
      return;
    }
    for (const std::string& line : step.lines.empty() ? std::vector{step.line} : step.lines) run(line);
    apply(history_, step.patch);
    if (!pair_up(history_, replay_.state, numbers_)) refuse("it makes something else now than it did then");
  }

  const State& state() const { return replay_.state; }
  const std::string& text() const { return text_; }

 private:
  void run(const std::string& line) {
    Call call = parse_script_line(line, units_of(replay_.state));
    if (call.command == nullptr || call.command->name == "save") return;
    const auto* edit = std::get_if<EditFunction>(&call.command->run);
    if (edit == nullptr) refuse("its lines are not in the journal");
    if (!are_same(numbers_)) call = renumbered(call, numbers_);
    replay_.report = {};
    (*edit)(replay_, call.arguments);
    text_ += call.line + "\n";
  }

  State history_;
  Edit replay_;
  std::string clipboard_;  ///< what `cut` leaves for `paste`; the user's stays as it is
  Numbers numbers_;
  std::string text_;
};

/// The first step after the last change by another program.
std::size_t first_step(const Session& session) {
  std::size_t first = session.done();
  while (first > 0 && session.steps()[first - 1].line != kOutsideChange) --first;
  return first;
}

}  // namespace

std::string history_script(const Session& session) {
  const std::size_t first = first_step(session);
  State before = session.state();
  for (std::size_t i = session.done(); i > first; --i) apply(before, inverse(session.steps()[i - 1].patch));
  const std::string file = session.file().string();
  Writer writer(before, file);
  for (std::size_t i = first; i < session.done(); ++i) {
    const Step& step = session.steps()[i];
    try {
      writer.add(step);
    } catch (const Error& error) {
      refuse("history: step {}, `{}`, cannot be repeated by a script: {}", i + 1, printable(step.line),
             error.what());
    }
  }
  if (map::print(document_of(writer.state(), file)) != session.text())
    refuse("history: the steps make another map now than they did then");
  const std::string begin =
      before.entities.empty() ? "an empty map" : fmt::format("the map as it was before step {}", first + 1);
  return fmt::format("# Begins with {}.\n", begin) + writer.text();
}

}  // namespace hallway::editor
