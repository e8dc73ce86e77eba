// SPDX-License-Identifier: MIT
#include "man_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "base/text.hpp"
#include "program.hpp"

namespace hallway::cli {
namespace {

/// Day of the release that the pages describe, as man(7) wants one.
constexpr const char* kDate = "2026-11-24";

/// The number of a character in UTF-8 at `at`, which is moved behind it.
std::uint32_t next_character(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(at++);
  if (first < 0x80) return first;
  std::uint32_t number = first & (first < 0xe0 ? 0x1f : first < 0xf0 ? 0x0f : 0x07);
  while (at < text.size() && (byte(at) & 0xc0) == 0x80) number = (number << 6) | (byte(at++) & 0x3f);
  return number;
}

/// Text as roff prints it: nothing in it is a request or an escape.
std::string escaped(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::uint32_t c = next_character(text, at);
    if (c >= 0x80) {
      out += fmt::format("\\[u{:04X}]", c);
    } else if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else if (c == '\'') {
      out += "\\(aq";
    } else if (c == '`') {
      out += "\\(ga";
    } else if (c == '^') {
      out += "\\(ha";
    } else if (c == '~') {
      out += "\\(ti";
    } else {
      out += static_cast<char>(c);
    }
  }
  if (out.starts_with('.')) out.insert(0, "\\&");
  return out;
}

/// Words filled into lines of at most 72 characters, as sources of pages have them.
std::string filled(std::string_view text) {
  constexpr std::size_t kWidth = 72;
  std::string out;
  std::size_t column = 0;
  for (const std::string_view word : split(text, ' ')) {
    if (word.empty()) continue;
    const std::string piece = escaped(word);
    if (column > 0 && column + 1 + piece.size() > kWidth) {
      out += '\n';
      column = 0;
    } else if (column > 0) {
      out += ' ';
      ++column;
    }
    out += piece;
    column += piece.size();
  }
  return out + "\n";
}

/// The words of a command, joined; those of `hallway robot` would name the page of the program `hallway-robot`.
std::string page_of(const Command& command) {
  std::string name = command.path();
  if (name == "hallway robot") return "hallway-robot-file";
  std::ranges::replace(name, ' ', '-');
  return name;
}

/// The lines of a footer in two parts: what it says, and its examples.
struct Footer {
  std::vector<std::string> text{};
  std::vector<std::string> examples{};
};

Footer footer_of(const Command& command) {
  Footer footer;
  bool example = false;
  if (command.footer().empty()) return footer;
  for (const std::string_view line : split(command.footer(), '\n')) {
    std::string_view rest = line;
    for (const std::string_view mark : {"Examples: ", "Example: "}) {
      if (!line.starts_with(mark)) continue;
      example = true;
      rest = line.substr(mark.size());
    }
    example &= rest.size() < line.size() || line.starts_with(' ');
    (example ? footer.examples : footer.text).emplace_back(trim(rest));
  }
  return footer;
}

std::string number_text(double number) {
  return format_double(number);
}

/// What an option may be given: its words, or its smallest and largest number.
std::string limits_text(const Option& option) {
  if (!option.words().empty()) return fmt::format(" One of: {}.", fmt::join(option.words(), ", "));
  if (!option.limits()) return "";
  return fmt::format(" From {} to {}.", number_text(option.limits()->first),
                     number_text(option.limits()->second));
}

std::string value_of(const Option& option) {
  return option.value_name().empty() ? "VALUE" : option.value_name();
}

std::string entry(const Option& option) {
  std::string head;
  if (option.is_argument()) {
    head = "\\fI" + escaped(value_of(option)) + "\\fR";
  } else {
    for (const std::string& name : option.name_list())
      head += (head.empty() ? "" : ", ") + ("\\fB" + escaped(name) + "\\fR");
    if (!option.is_flag()) head += " \\fI" + escaped(value_of(option)) + "\\fR";
  }
  return ".TP\n" + head + "\n" + filled(option.help() + "." + limits_text(option));
}

std::string synopsis(const Command& command) {
  std::string line = ".B " + escaped(command.path()) + "\n";
  if (!command.commands().empty()) return line + ".I COMMAND\n.RI [ OPTIONS ]\n";
  line += ".RI [ OPTIONS ]\n";
  for (const Option* argument : command.arguments()) {
    const std::string name = escaped(value_of(*argument));
    line += argument->is_required() ? ".I " + name + "\n" : ".RI [ " + name + " ]\n";
  }
  return command.rest() != nullptr ? line + ".RI [ WORD ...]\n" : line;
}

std::string options_section(const Command& command) {
  std::string arguments, options;
  for (const auto& option : command.options())
    (option->is_argument() ? arguments : options) += entry(*option);
  options += ".TP\n\\fB\\-h\\fR, \\fB\\-\\-help\\fR\nPrint a help message and exit.\n";
  if (!command.version().empty()) options += ".TP\n\\fB\\-\\-version\\fR\nPrint the version and exit.\n";
  return (arguments.empty() ? "" : ".SH ARGUMENTS\n" + arguments) + ".SH OPTIONS\n" + options;
}

std::string commands_section(const Command& command) {
  if (command.commands().empty()) return "";
  std::string text = ".SH COMMANDS\n";
  for (const auto& below : command.commands())
    text += ".TP\n.BR " + escaped(page_of(*below)) + " (1)\n" + filled(below->about() + ".");
  return text;
}

std::string see_also(const Command& command) {
  if (command.parent() == nullptr) return "";
  std::string text = ".SH SEE ALSO\n";
  std::string line;
  for (const Command* above = command.parent(); above != nullptr; above = above->parent())
    text += line.empty() ? line = ".BR " + escaped(page_of(*above)) + " (1)\n"
                         : ".BR " + escaped(page_of(*above)) + " (1)\n";
  return text;
}

}  // namespace

std::string man_page_name(const Command& command) {
  return page_of(command) + ".1";
}

std::vector<const Command*> with_commands_below(const Command& command) {
  std::vector<const Command*> all{&command};
  for (const auto& below : command.commands()) {
    for (const Command* each : with_commands_below(*below)) all.push_back(each);
  }
  return all;
}

std::string print_man_page(const Command& command) {
  const Command* program = &command;
  while (program->parent() != nullptr) program = program->parent();
  std::string title = page_of(command);
  std::ranges::transform(title, title.begin(), [](unsigned char c) { return std::toupper(c); });
  std::string text = fmt::format(".\\\" SPDX-License-Identifier: MIT\n.TH {} 1 {} \"{}\" \"Hallway\"\n",
                                 escaped(title), kDate, program->version());
  text += ".SH NAME\n" + escaped(page_of(command)) + " \\- " + filled(command.summary());
  text += ".SH SYNOPSIS\n" + synopsis(command);
  const Footer footer = footer_of(command);
  text += ".SH DESCRIPTION\n";
  std::string about = command.about();
  std::ranges::replace(about, '\n', ' ');
  text += filled(about.ends_with('.') ? about : about + ".");
  for (const std::string& line : footer.text) {
    if (!line.empty() && &command != program) text += ".PP\n" + filled(line);
  }
  text += commands_section(command) + options_section(command);
  std::string statuses = kExitStatusHelp;
  std::ranges::replace(statuses, '\n', ' ');
  text += ".SH EXIT STATUS\n" + filled(statuses.substr(statuses.find(": ") + 2));
  if (!footer.examples.empty()) {
    text += ".SH EXAMPLES\n.nf\n";
    for (const std::string& line : footer.examples) text += escaped(line) + "\n";
    text += ".fi\n";
  }
  return text + see_also(command);
}

}  // namespace hallway::cli
