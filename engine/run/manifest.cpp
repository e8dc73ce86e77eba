// SPDX-License-Identifier: MIT
#include "run/manifest.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <fstream>

#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/text.hpp"
#include "record/version.hpp"

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

Json describe_host(const ManifestFacts& facts) {
  return {{"cpu", cpu_name()},
          {"threads", facts.threads},
          {"trace", trace::backend_description(facts.trace)},
          {"compiler", compiler_name()},
          {"plugin_files", Json::array()},
          {"isolated", nullptr},
          {"started_utc", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))}};
}

}  // namespace

Json make_manifest(const ManifestFacts& facts) {
  Json inputs = Json::array();
  for (const Attachment& input : facts.inputs) {
    inputs.push_back({{"file", printable(input.name)}, {"hash", content_hash(input.content)}});
  }
  Json settings = Json::array();
  for (const sim::Setting& setting : facts.settings) {
    settings.push_back({{"key", setting.key}, {"value", setting.value}, {"origin", setting.origin}});
  }
  return {{"schema", "hallway.run/1"},  {"hallway", record::version()},
          {"command", facts.command},   {"name", facts.name},
          {"inputs", inputs},           {"period_ns", facts.period_ns},
          {"settings", settings},       {"plugins", Json::array()},
          {"warnings", facts.warnings}, {"host", describe_host(facts)}};
}

Json make_manifest(const ManifestFacts& facts, host::Pipeline& pipeline) {
  Json manifest = make_manifest(facts);
  for (std::size_t i = 0; i < pipeline.size(); ++i) {
    host::Stage& stage = pipeline.stage(i);
    manifest["plugins"].push_back(record::print_plugin(facts.parameters, stage));
    manifest["host"]["plugin_files"].push_back(printable(stage.file().string(), 4096));
  }
  manifest["host"]["isolated"] = pipeline.isolated();
  return manifest;
}

Json print_failure(const Failure& failure) {
  return record::print_verdict(failure.verdict, failure.iteration);
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
