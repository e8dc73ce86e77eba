// SPDX-License-Identifier: MIT
#include "record/manifest.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <ctime>
#include <fstream>

#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/text.hpp"
#include "record/version.hpp"

namespace hallway::record {
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

Json describe_host() {
  return {{"cpu", cpu_name()},
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
  for (const Setting& setting : facts.settings) {
    settings.push_back({{"key", setting.key}, {"value", setting.value}, {"origin", setting.origin}});
  }
  return {{"schema", "hallway.run/1"}, {"hallway", version()},     {"command", facts.command},
          {"name", facts.name},        {"inputs", inputs},         {"period_ns", facts.period_ns},
          {"settings", settings},      {"plugins", Json::array()}, {"warnings", facts.warnings},
          {"host", describe_host()}};
}

Json make_manifest(const ManifestFacts& facts, const host::Pipeline& pipeline) {
  Json manifest = make_manifest(facts);
  manifest["plugins"] = print_plugins(facts.parameters, pipeline);
  for (const host::StageFacts& plugin : pipeline.facts())
    manifest["host"]["plugin_files"].push_back(printable(plugin.file.string(), 4096));
  manifest["host"]["isolated"] = pipeline.isolated();
  return manifest;
}

void write_json(const std::filesystem::path& path, const Json& document) {
  write_file_atomically(path, document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace hallway::record
