// SPDX-License-Identifier: MIT
#include "plugin_report.hpp"

#include <fmt/format.h>
#include <hallway/ext/log.h>

namespace hallway::cli {

void print_plugin_log(const std::string& plugin, std::uint32_t level, const std::string& message) {
  if (level >= HW_LOG_WARNING) fmt::print(stderr, "hallway: {}: {}\n", plugin, message);
}

void print_failures(const record::Failures& failures) {
  for (const record::Failure& failure : failures.verdicts) {
    const std::string at = failure.iteration ? fmt::format("iteration {}: ", *failure.iteration) : "";
    fmt::print(stderr, "hallway: {}{}\n", at, failure.verdict.message);
    for (const std::string& line : failure.verdict.backtrace) fmt::print(stderr, "    {}\n", line);
  }
  if (failures.count > failures.verdicts.size()) {
    fmt::print(stderr, "hallway: {} failures more\n", failures.count - failures.verdicts.size());
  }
}

std::vector<std::string> plugin_names(const nlohmann::ordered_json& manifest) {
  std::vector<std::string> names;
  for (const auto& plugin : manifest.at("plugins")) {
    names.push_back(plugin.at("id").get<std::string>());
    const auto version = plugin.at("version").get<std::string>();
    if (!version.empty()) names.back() += " " + version;
  }
  return names;
}

}  // namespace hallway::cli
