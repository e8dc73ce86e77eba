// SPDX-License-Identifier: MIT
#include "plugin_argument.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "host/plugin_table.hpp"

namespace hallway::cli {
namespace {

[[noreturn]] void refuse_plugin(const std::string& text, const std::string& why) {
  refuse("--plugin {}: {}; it takes NAME|FILE[:KEY=VALUE,...]", printable(text), why);
}

[[noreturn]] void refuse_second_value(const std::string& name) {
  refuse("{} has a value by --plugin and by --set: leave out one", printable(name));
}

/// Where the plugin's name ends: before the ":" of its parameters, if it has any.
std::size_t end_of_name(const std::string& text) {
  constexpr std::string_view kEnding = ".so:";
  const std::size_t file = text.find(kEnding);
  if (file == std::string::npos)
    return text.ends_with(".so") ? text.size() : std::min(text.find(':'), text.size());
  const std::size_t end = file + kEnding.size() - 1;
  const std::size_t next = std::min(text.find(':', end + 1), text.size());
  const bool is_id = next > end + 1 && text.find('=', end) >= next;  // FILE.so:ID
  return is_id ? next : end;
}

}  // namespace

PluginArgument parse_plugin_argument(const std::string& text) {
  PluginArgument argument;
  const std::size_t end = end_of_name(text);
  argument.plugin = text.substr(0, end);
  if (argument.plugin.empty()) refuse_plugin(text, "a plugin has a name");
  if (end == text.size()) return argument;
  for (const std::string_view group : split(std::string_view(text).substr(end + 1), ':')) {
    bool first = true;
    for (const std::string_view part : split(group, ',')) {
      const std::size_t equals = part.find('=');
      if (equals == 0 || (first && equals == std::string_view::npos))
        refuse_plugin(text, fmt::format("\"{}\" is not KEY=VALUE", printable(part)));
      if (equals == std::string_view::npos) {
        argument.parameters.back().values.emplace_back(part);
      } else {
        argument.parameters.push_back(
            {std::string(part.substr(0, equals)), {std::string(part.substr(equals + 1))}});
      }
      first = false;
    }
  }
  return argument;
}

host::StageSpec parse_plugin(const std::string& text) {
  const PluginArgument argument = parse_plugin_argument(text);
  host::StageSpec spec{.plugin = argument.plugin, .parameters = {}};
  for (const PluginArgument::Values& parameter : argument.parameters) {
    if (parameter.values.size() != 1)
      refuse_plugin(text, fmt::format("{} has {} values; `hallway compare` tries several",
                                      printable(parameter.name), parameter.values.size()));
    spec.parameters.push_back({parameter.name, parameter.values.front(), {.file = "--plugin"}});
  }
  return spec;
}

std::vector<Override> plugin_overrides(const std::string& text) {
  const host::StageSpec spec = parse_plugin(text);
  std::vector<Override> overrides{{"plugin", spec.plugin}};
  for (const auto& parameter : spec.parameters)
    overrides.push_back({host::short_plugin_name(spec.plugin) + "." + parameter.name, parameter.value});
  return overrides;
}

Override parse_setting(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    refuse("--set takes KEY=VALUE, not \"{}\"", printable(text));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

void refuse_second_values(const std::string& plugin, const std::vector<std::string>& settings) {
  const PluginArgument wanted = parse_plugin_argument(plugin);
  const std::string prefix = host::short_plugin_name(wanted.plugin) + ".";
  for (const std::string& text : settings) {
    const std::string key = parse_setting(text).key;
    const std::string name = key.starts_with(prefix) ? key.substr(prefix.size()) : key;
    if (std::ranges::find(wanted.parameters, name, &PluginArgument::Values::name) != wanted.parameters.end())
      refuse_second_value(name);
  }
}

void refuse_whose(const Override& setting, const std::vector<std::string>& plugins) {
  refuse("--set {}={}: which plugin's? Several run: {}; write PLUGIN.{}=VALUE", printable(setting.key),
         printable(setting.value), fmt::join(plugins, ", "), printable(setting.key));
}

std::pair<const host::StageSpec*, std::string> set_parameter(std::span<host::StageSpec> stages,
                                                             const std::string& text) {
  const Override setting = parse_setting(text);
  const std::size_t dot = setting.key.rfind('.');
  const std::string wanted = dot == std::string::npos ? "" : setting.key.substr(0, dot);
  const std::string name = dot == std::string::npos ? setting.key : setting.key.substr(dot + 1);
  std::vector<std::string> names;
  host::StageSpec* stage = wanted.empty() && stages.size() == 1 ? &stages.front() : nullptr;
  for (host::StageSpec& candidate : stages) {
    names.push_back(host::short_plugin_name(candidate.plugin));
    if (names.back() == wanted) stage = &candidate;
  }
  if (stage == nullptr && wanted.empty()) refuse_whose(setting, names);
  if (stage == nullptr)
    refuse("--set {}: no plugin \"{}\" runs{}; there is: {}", printable(text), printable(wanted),
           suggestion(wanted, names), fmt::join(names, ", "));
  for (const host::ParameterSetting& parameter : stage->parameters) {
    if (parameter.name == name && parameter.where.file == "--plugin") refuse_second_value(name);
  }
  std::erase_if(stage->parameters, [&](const auto& parameter) { return parameter.name == name; });
  stage->parameters.push_back({name, setting.value, {.file = "--set"}});
  return {stage, name};
}

}  // namespace hallway::cli
