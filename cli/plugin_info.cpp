// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "host/isolate/isolated_plugin.hpp"
#include "host/output/output_kind.hpp"
#include "host/samples/sample_kind.hpp"
#include "isolation_options.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

struct PluginInfoOptions {
  std::string plugin;
  std::vector<std::string> plugin_path;
  bool json = false;
};

std::vector<std::string> names_of(const std::vector<std::uint32_t>& kinds,
                                  std::string (*name)(std::uint32_t)) {
  std::vector<std::string> names;
  for (const std::uint32_t kind : kinds) names.push_back(name(kind));
  return names;
}

/// What a parameter may be: "0.001 to 10", "exact, fast".
std::string range_of(const host::Parameter& parameter) {
  if (parameter.default_value.type == HW_PARAM_CHOICE)
    return fmt::format("{}", fmt::join(parameter.choices, ", "));
  if (parameter.default_value.type == HW_PARAM_BOOL) return "true, false";
  if (parameter.is_path()) return parameter.writable ? "is written" : "is read";
  if (parameter.is_text()) return "any";
  return parameter.print(parameter.minimum) + " to " + parameter.print(parameter.maximum);
}

std::string text_of(const host::Stage& plugin) {
  const host::PluginInfo& info = plugin.info();
  std::string text = fmt::format("{} {}\n{}\n", info.id, info.version, info.description);
  const auto line = [&](const char* name, const std::string& value) {
    if (!value.empty()) text += fmt::format("  {:<9} {}\n", name, value);
  };
  line("name", info.name);
  line("vendor", info.vendor);
  line("file", path_text(plugin.file()));
  line("takes", fmt::format("{}", fmt::join(names_of(info.inputs, &host::sample_kind_name), ", ")));
  if (!info.optional_inputs.empty())
    line("may take",
         fmt::format("{}", fmt::join(names_of(info.optional_inputs, &host::sample_kind_name), ", ")));
  line("gives", fmt::format("{}", fmt::join(names_of(info.outputs, &host::output_kind_name), ", ")));
  if (plugin.parameters().empty()) return text + "no parameters\n";
  text += "parameters, set by --set " + info.id + ".NAME=VALUE or in a scenario:\n";
  for (const host::Parameter& parameter : plugin.parameters()) {
    const bool bare = parameter.unit.empty() || parameter.unit == "1";  // a ratio
    const std::string unit = bare ? "" : " " + parameter.unit;
    text += fmt::format("  {} = {}{}  ({}: {})\n      {}\n", parameter.name, parameter.default_value_text(),
                        unit, parameter.type_name(), range_of(parameter), parameter.help);
  }
  return text;
}

Json json_of(const host::Stage& plugin) {
  const host::PluginInfo& info = plugin.info();
  Json parameters = Json::array();
  for (const host::Parameter& parameter : plugin.parameters()) {
    Json one{{"name", parameter.name},
             {"type", parameter.type_name()},
             {"unit", parameter.unit},
             {"default", parameter.default_value_text()},
             {"help", parameter.help}};
    if (parameter.default_value.type == HW_PARAM_CHOICE) {
      one["choices"] = parameter.choices;
    } else if (parameter.is_path()) {
      one["writable"] = parameter.writable;
    } else if (parameter.default_value.type != HW_PARAM_BOOL && !parameter.is_text()) {
      one["minimum"] = parameter.print(parameter.minimum);
      one["maximum"] = parameter.print(parameter.maximum);
    }
    parameters.push_back(std::move(one));
  }
  Json json{{"schema", "hallway.plugin_info/1"},
            {"id", info.id},
            {"name", info.name},
            {"version", info.version},
            {"vendor", info.vendor},
            {"description", info.description},
            {"file", path_text(plugin.file())},
            {"inputs", names_of(info.inputs, &host::sample_kind_name)},
            {"outputs", names_of(info.outputs, &host::output_kind_name)},
            {"parameters", std::move(parameters)}};
  if (!info.optional_inputs.empty())
    json["optional_inputs"] = names_of(info.optional_inputs, &host::sample_kind_name);
  return json;
}

int show(const PluginInfoOptions& options) {
  const auto isolation = isolation_of({}, {});
  host::IsolatedPlugin plugin(options.plugin, plugin_folders(options.plugin_path), *isolation);
  if (options.json) {
    print_json(json_of(plugin));
  } else {
    print_result(text_of(plugin));
  }
  plugin.close();
  return 0;
}

}  // namespace

void add_plugin_info_command(Command& plugin) {
  Command& command = plugin.command("info", "Show a plugin's inputs, outputs and parameters");
  PluginInfoOptions& options = command.runs(&show);
  command.argument("plugin", &options.plugin, "A plugin's id, or its file").value("NAME|FILE").required();
  add_plugin_path_option(command, options.plugin_path);
  add_shared(command, Shared::kJson, &options.json);
  command.footer("Example: hallway plugin info slam_point");
}

}  // namespace hallway::cli
