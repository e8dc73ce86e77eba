// SPDX-License-Identifier: MIT
#include "record/manifest.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

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

Json describe_host(host::Pipeline& pipeline) {
  Json files = Json::array();
  for (std::size_t i = 0; i < pipeline.size(); ++i)
    files.push_back(printable(pipeline.stage(i).file().string(), 4096));
  return {{"cpu", cpu_name()},
          {"compiler", compiler_name()},
          {"plugin_files", files},
          {"isolated", pipeline.isolated()},
          {"started_utc", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))}};
}

}  // namespace

Json make_manifest(const ManifestFacts& facts, host::Pipeline& pipeline) {
  Json inputs = Json::array();
  for (const Attachment& input : facts.inputs) {
    inputs.push_back({{"file", printable(input.name)}, {"hash", content_hash(input.content)}});
  }
  Json settings = Json::array();
  for (const Setting& setting : facts.settings) {
    settings.push_back({{"key", setting.key}, {"value", setting.value}, {"origin", setting.origin}});
  }
  Json plugins = Json::array();
  for (std::size_t i = 0; i < pipeline.size(); ++i)
    plugins.push_back(print_plugin(facts.parameters, pipeline.stage(i)));
  return {{"schema", "hallway.run/1"},  {"hallway", version()},
          {"command", facts.command},   {"name", facts.name},
          {"inputs", inputs},           {"period_ns", facts.period_ns},
          {"settings", settings},       {"plugins", plugins},
          {"warnings", facts.warnings}, {"host", describe_host(pipeline)}};
}

void write_json(const std::filesystem::path& path, const Json& document) {
  write_file_atomically(path, document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace hallway::record
