// SPDX-License-Identifier: MIT
#include "run/feed/plugin_log.hpp"

#include <fmt/format.h>
#include <hallway/ext/log.h>

#include <utility>

namespace hallway::run {

host::LogSink PluginLog::sink(host::LogSink next) {
  return [this, next = std::move(next)](const std::string& plugin, std::uint32_t level,
                                        const std::string& message) {
    add(plugin, level, message);
    if (next) next(plugin, level, message);
  };
}

void PluginLog::add(const std::string& plugin, std::uint32_t level, const std::string& message) {
  const std::lock_guard lock(mutex_);
  if (lines_.size() < kMaxLines) {
    lines_.push_back({level, plugin, message});
  } else {
    ++dropped_;
  }
}

std::vector<foxglove::LogLine> PluginLog::take() {
  const std::lock_guard lock(mutex_);
  std::vector<foxglove::LogLine> lines = std::exchange(lines_, {});
  if (const std::size_t dropped = std::exchange(dropped_, 0u); dropped != 0) {
    lines.push_back({HW_LOG_WARNING, "hallway", fmt::format("{} lines more, which are left out", dropped)});
  }
  return lines;
}

}  // namespace hallway::run
