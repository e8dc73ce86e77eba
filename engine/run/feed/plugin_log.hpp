// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <vector>

#include "foxglove/messages.hpp"
#include "host/stage.hpp"

namespace hallway::run {

/// What plugins log while a run goes on, kept until it is taken. Safe on any thread.
class PluginLog {
 public:
  /// A sink that keeps what it gets and passes it on. This must live as long as the sink.
  host::LogSink sink(host::LogSink next);
  /// What came since the last call, in that order. Of many lines the first kMaxLines, and how many more there were.
  std::vector<foxglove::LogLine> take();

  static constexpr std::size_t kMaxLines = 1000;

 private:
  void add(const std::string& plugin, std::uint32_t level, const std::string& message);

  std::mutex mutex_;
  std::vector<foxglove::LogLine> lines_;
  std::size_t dropped_ = 0;
};

}  // namespace hallway::run
