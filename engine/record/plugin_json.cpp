// SPDX-License-Identifier: MIT
#include "record/plugin_json.hpp"

#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/origin.hpp"
#include "base/text.hpp"
#include "host/plugin_table.hpp"

namespace hallway::record {
namespace {

using Json = nlohmann::ordered_json;

std::string origin_of(const std::vector<ParameterOrigin>& origins, const std::string& plugin,
                      const std::string& parameter) {
  std::string origin = "default";
  for (const ParameterOrigin& known : origins) {
    if (known.plugin == plugin && known.name == parameter) origin = known.origin;  // the last one counts
  }
  return origin;
}

Json describe(const std::vector<ParameterOrigin>& origins, const host::StageFacts& plugin) {
  Json parameters = Json::array();
  for (std::size_t i = 0; i < plugin.values.size(); ++i) {
    const host::Parameter& parameter = plugin.parameters[i];
    const bool from_sensor = i < plugin.from_sensor.size() && plugin.from_sensor[i];
    Json one{{"name", parameter.name},
             {"value", parameter.is_path() ? printable(plugin.values[i], 4096) : plugin.values[i]},
             {"unit", parameter.unit},
             {"origin", from_sensor ? "sensor" : origin_of(origins, plugin.info.id, parameter.name)}};
    if (parameter.is_text()) one["type"] = parameter.type_name();
    parameters.push_back(std::move(one));
  }
  return {{"id", plugin.info.id},
          {"version", plugin.info.version},
          {"hash", content_hash(read_file(plugin.file))},
          {"parameters", parameters}};
}

/// One that ended before it could say what it is: what was asked for.
Json describe(const std::vector<ParameterOrigin>& origins, const host::StageSpec& wanted) {
  const std::string id = printable(host::short_plugin_name(wanted.plugin));
  Json parameters = Json::array();
  for (const host::ParameterSetting& setting : wanted.parameters) {
    parameters.push_back({{"name", printable(setting.name)},
                          {"value", printable(setting.value)},
                          {"unit", ""},
                          {"origin", origin_of(origins, id, setting.name)}});
  }
  return {{"id", id}, {"version", ""}, {"hash", nullptr}, {"parameters", parameters}};
}

}  // namespace

std::vector<ParameterOrigin> origins_of(std::span<const host::StageSpec> stages) {
  std::vector<ParameterOrigin> origins;
  for (const host::StageSpec& stage : stages) {
    const std::string plugin = host::short_plugin_name(stage.plugin);
    for (const host::ParameterSetting& parameter : stage.parameters) {
      origins.push_back(
          {plugin, parameter.name, hallway::origin_of(parameter.where.file, parameter.where.line)});
    }
  }
  return origins;
}

Json print_plugins(const std::vector<ParameterOrigin>& origins, const host::Pipeline& pipeline) {
  Json plugins = Json::array();
  for (std::size_t i = 0; i < pipeline.specs().size(); ++i) {
    const bool known = i < pipeline.facts().size();
    const bool asked = known && pipeline.facts()[i].values.size() == pipeline.facts()[i].parameters.size();
    Json plugin = describe(origins, pipeline.specs()[i]);
    if (known) {
      Json said = describe(origins, pipeline.facts()[i]);
      if (!asked) said["parameters"] = plugin["parameters"];
      plugin = std::move(said);
    }
    plugins.push_back(std::move(plugin));
  }
  return plugins;
}

Json print_verdict(const host::Verdict& verdict, std::optional<std::uint32_t> iteration) {
  Json json{{"what", host::misdeed_name(verdict.what)}, {"plugin", verdict.plugin}};
  json["signal"] = verdict.what == host::Misdeed::kCrash ? Json(verdict.signal) : Json(nullptr);
  json["exit_status"] = verdict.what == host::Misdeed::kExit ? Json(verdict.exit_status) : Json(nullptr);
  json["iteration"] = iteration ? Json(*iteration) : Json(nullptr);
  json["call"] = verdict.call;
  json["message"] = verdict.message;
  json["backtrace"] = verdict.backtrace;
  return json;
}

}  // namespace hallway::record
