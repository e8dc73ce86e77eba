// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "host/stage.hpp"
#include "run/feed/plugin_log.hpp"
#include "run/feed/run.hpp"
#include "run/sources/source.hpp"
#include "sim/simulator.hpp"
#include "watch/live_moments.hpp"
#include "watch_screen.hpp"

namespace hallway::cli {

/// Shows a run while it goes on. It reads what the run makes and changes nothing of it; when the person pauses, the run waits.
class Watcher {
 public:
  explicit Watcher(WatchStyle style) : style_(std::move(style)) {}

  /// Takes what plugins log, on any thread. While nothing is drawn, warnings go to standard error.
  host::LogSink log_sink();
  /// Opens the view.
  /// @param manifest  run.json as known before the first frame
  void begin(const sim::Simulator& simulator, const run::Source& source,
             const nlohmann::ordered_json& manifest);
  /// Shows each iteration.
  void add_to(run::RunHooks& hooks);
  /// The run is over: stays until the person closes the view.
  /// @param folder  what it has written
  void finish(const std::filesystem::path& folder);
  /// Gives the terminal back, where it is drawn on.
  void close();

 private:
  void show(const watch::Moment& moment);

  WatchStyle style_;
  run::PluginLog log_;
  host::LogSink keep_ = log_.sink({});
  std::atomic<bool> shows_lines_ = true;
  std::optional<watch::LiveMoments> moments_;
  std::uint32_t iterations_ = 0;
  std::optional<Screen> screen_;
};

}  // namespace hallway::cli
