// SPDX-License-Identifier: MIT
#include "editor/help.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "base/text.hpp"
#include "editor/anchor.hpp"

namespace hallway::editor {
namespace {

std::string usage_of(const ArgSpec& spec) {
  const std::string text =
      spec.kind == ArgKind::kKeys ? type_name(spec) : fmt::format("{}={}", spec.name, type_name(spec));
  return spec.required ? text : "[" + text + "]";
}

std::string help_of(const ArgSpec& spec) {
  std::string text(spec.help);
  if (!spec.fallback.empty()) text += fmt::format(" [{}]", spec.fallback);
  return text;
}

/// The text in lines that a terminal has room for.
std::string wrapped(std::string_view text, std::string_view indent) {
  constexpr std::size_t kColumns = 96;
  std::string out, line;
  for (const std::string_view word : split(text, ' ')) {
    if (!line.empty() && indent.size() + line.size() + 1 + word.size() > kColumns) {
      out += std::string(indent) + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + std::string(word);
  }
  return out + std::string(indent) + line + "\n";
}

/// The lines of an example, those it needs first.
std::vector<std::string_view> example_lines(const CommandSpec& command) {
  std::vector<std::string_view> lines;
  if (!command.before.empty()) lines = split(command.before, '\n');
  lines.push_back(command.example);
  return lines;
}

std::string example_text(const CommandSpec& command) {
  std::string text;
  for (const std::string_view line : example_lines(command)) text += fmt::format("    {}\n", line);
  return text;
}

std::string capitalised(std::string_view text) {
  std::string out(text);
  out[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(out[0])));
  return out;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '<') out += '\\';
    out += c;
  }
  return out;
}

bool takes_places(const CommandSpec& command) {
  return std::ranges::any_of(command.arguments, [](const ArgSpec& spec) {
    return spec.kind == ArgKind::kPlace || spec.kind == ArgKind::kPlaces;
  });
}

std::string place_help() {
  return fmt::format(
      "A place is X,Y[,Z], or @NAME.ANCHOR of a thing, with or without +DX,DY[,DZ]: @hall.ne, "
      "@north.end+0.1,0. Anchors: {}.",
      anchor_names());
}

}  // namespace

std::string usage(const CommandSpec& command) {
  std::string text(command.name);
  for (const ArgSpec& spec : command.arguments) text += " " + usage_of(spec);
  return text;
}

std::string help_text(const CommandSpec& command) {
  std::string text = usage(command) + "\n  " + std::string(command.summary) + "\n";
  if (!command.details.empty()) text += wrapped(command.details, "  ");
  for (const ArgSpec& spec : command.arguments)
    text += fmt::format("    {:<14} {:<14} {}\n", spec.name, type_name(spec), help_of(spec));
  if (takes_places(command)) text += wrapped(place_help(), "  ");
  text += "  Example:\n";
  text += example_text(command);
  text.pop_back();
  return text;
}

std::string help_overview() {
  std::string text;
  std::string_view topic;
  for (const CommandSpec& command : commands()) {
    if (command.topic != topic) text += fmt::format("{}\n", topic = command.topic);
    text += fmt::format("  {:<12} {}\n", command.name, command.summary);
  }
  return text +
         "`help NAME` explains one. Arguments are `name value`, `name=value`, or values in their order.\n" +
         place_help();
}

std::string reference_markdown() {
  std::string text;
  std::string_view topic;
  for (const CommandSpec& command : commands()) {
    if (command.topic != topic) text += fmt::format("\n### {}\n", capitalised(topic = command.topic));
    text += fmt::format("\n#### {}\n\n    {}\n\n{}.\n", command.name, usage(command),
                        capitalised(command.summary));
    if (!command.details.empty()) text += fmt::format("\n{}\n", command.details);
    if (!command.arguments.empty()) text += "\n| argument | type | what |\n|---|---|---|\n";
    for (const ArgSpec& spec : command.arguments) {
      text += fmt::format("| `{}`{} | {} | {} |\n", spec.name, spec.required ? "" : " (optional)",
                          escaped(type_name(spec)), escaped(help_of(spec)));
    }
    text += "\nExample:\n\n" + example_text(command);
  }
  return text;
}

nlohmann::ordered_json reference_json() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const CommandSpec& command : commands()) {
    nlohmann::ordered_json arguments = nlohmann::ordered_json::array();
    for (const ArgSpec& spec : command.arguments) {
      nlohmann::ordered_json one = {
          {"name", spec.name}, {"type", type_name(spec)}, {"required", spec.required}};
      if (!spec.fallback.empty()) one["default"] = spec.fallback;
      if (!spec.choices.empty()) {
        for (const std::string_view choice : split(spec.choices, ' ')) one["choices"].push_back(choice);
      }
      one["help"] = spec.help;
      arguments.push_back(std::move(one));
    }
    list.push_back({{"name", command.name},
                    {"topic", command.topic},
                    {"summary", command.summary},
                    {"arguments", std::move(arguments)},
                    {"example", example_lines(command)}});
  }
  return list;
}

}  // namespace hallway::editor
