// SPDX-License-Identifier: MIT
#include "run/manifest.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <fstream>

#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/text.hpp"
#include "sim/scenario.hpp"

namespace hallway::run {
namespace {

using Json = nlohmann::ordered_json;

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  std::string line;
  while (std::getline(info, line)) {
    const std::size_t colon = line.find(':');
    if (line.starts_with("model name") && colon != std::string::npos) {
      return printable(trim(std::string_view(line).substr(colon + 1)));
    }
  }
  return "unknown";
}

std::string compiler_name() {
#if defined(__clang__)
  return "clang " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

Json describe_host(const ManifestFacts& facts, const host::Pipeline& pipeline) {
  Json files = Json::array();
  for (const host::StageFacts& plugin : pipeline.facts())
    files.push_back(printable(plugin.file.string(), 4096));
  return {{"cpu", cpu_name()},
          {"threads", facts.threads},
          {"trace", trace::backend_description(facts.trace)},
          {"compiler", compiler_name()},
          {"plugin_files", files},
          {"isolated", pipeline.isolated()},
          {"started_utc", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))}};
}

std::string origin_of(const ManifestFacts& facts, const std::string& plugin, const std::string& parameter) {
  std::string origin = "default";
  for (const ParameterOrigin& known : facts.parameters) {
    if (known.plugin == plugin && known.name == parameter) origin = known.origin;  // the last one counts
  }
  return origin;
}

Json describe_plugin(const ManifestFacts& facts, const host::StageFacts& plugin) {
  Json parameters = Json::array();
  for (std::size_t i = 0; i < plugin.values.size(); ++i) {
    const host::Parameter& parameter = plugin.parameters[i];
    parameters.push_back({{"name", parameter.name},
                          {"value", plugin.values[i]},
                          {"unit", parameter.unit},
                          {"origin", origin_of(facts, plugin.info.id, parameter.name)}});
  }
  return {{"id", plugin.info.id},
          {"version", plugin.info.version},
          {"hash", content_hash(read_file(plugin.file))},
          {"parameters", parameters}};
}

/// One that ended before it could say what it is: what was asked for.
Json describe_plugin(const ManifestFacts& facts, const host::StageSpec& wanted) {
  const std::string id = printable(sim::short_plugin_name(wanted.plugin));
  Json parameters = Json::array();
  for (const host::ParameterSetting& setting : wanted.parameters) {
    parameters.push_back({{"name", printable(setting.name)},
                          {"value", printable(setting.value)},
                          {"unit", ""},
                          {"origin", origin_of(facts, id, setting.name)}});
  }
  return {{"id", id}, {"version", ""}, {"hash", nullptr}, {"parameters", parameters}};
}

Json describe_plugins(const ManifestFacts& facts, const host::Pipeline& pipeline) {
  Json plugins = Json::array();
  for (std::size_t i = 0; i < pipeline.specs().size(); ++i) {
    const bool known = i < pipeline.facts().size();
    const bool asked = known && pipeline.facts()[i].values.size() == pipeline.facts()[i].parameters.size();
    Json plugin = describe_plugin(facts, pipeline.specs()[i]);
    if (known) {
      Json said = describe_plugin(facts, pipeline.facts()[i]);
      if (!asked) said["parameters"] = plugin["parameters"];
      plugin = std::move(said);
    }
    plugins.push_back(std::move(plugin));
  }
  return plugins;
}

}  // namespace

std::string version() {
  return HALLWAY_VERSION;
}

Json make_manifest(const ManifestFacts& facts, const host::Pipeline& pipeline) {
  Json inputs = Json::array();
  for (const Attachment& input : facts.inputs) {
    inputs.push_back({{"file", printable(input.name)}, {"hash", content_hash(input.content)}});
  }
  Json settings = Json::array();
  for (const sim::Setting& setting : facts.settings) {
    settings.push_back({{"key", setting.key}, {"value", setting.value}, {"origin", setting.origin}});
  }
  return {{"schema", "hallway.run/1"},  {"hallway", version()},
          {"command", facts.command},   {"name", facts.name},
          {"inputs", inputs},           {"period_ns", facts.period_ns},
          {"settings", settings},       {"plugins", describe_plugins(facts, pipeline)},
          {"warnings", facts.warnings}, {"host", describe_host(facts, pipeline)}};
}

Json print_verdict(const host::Verdict& verdict) {
  return print_failure({verdict, std::nullopt});
}

Json print_failure(const Failure& failure) {
  const host::Verdict& verdict = failure.verdict;
  Json json{{"what", host::misdeed_name(verdict.what)}, {"plugin", verdict.plugin}};
  json["signal"] = verdict.what == host::Misdeed::kCrash ? Json(verdict.signal) : Json(nullptr);
  json["exit_status"] = verdict.what == host::Misdeed::kExit ? Json(verdict.exit_status) : Json(nullptr);
  json["iteration"] = failure.iteration ? Json(*failure.iteration) : Json(nullptr);
  json["call"] = verdict.call;
  json["message"] = verdict.message;
  json["backtrace"] = verdict.backtrace;
  return json;
}

void describe_failures(sim::OnFailure policy, const RunResult& result, Json& manifest) {
  manifest["on_failure"] = on_failure_name(policy);
  manifest["failures"] = result.failures;
  manifest["restarts"] = result.restarts;
  manifest["verdict"] = result.verdicts.empty() ? Json(nullptr) : print_failure(result.verdicts.front());
  if (result.verdicts.size() < 2) return;
  for (const Failure& failure : result.verdicts) manifest["verdicts"].push_back(print_failure(failure));
}

}  // namespace hallway::run
