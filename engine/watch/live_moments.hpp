// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "run/feed/plugin_log.hpp"
#include "run/feed/run.hpp"
#include "run/sources/source.hpp"
#include "watch/moment_maker.hpp"

namespace hallway::watch {

/// Makes the moments of a run that goes on. They are those of its log (LogMoments), and counters beside; lines of plugins' logs are in the moment of the frame
/// after which they came.
class LiveMoments {
 public:
  /// @param log  what the plugins log; must live as long
  LiveMoments(const run::Source& source, run::PluginLog& log);

  /// Adds to the hooks of the run that each moment is given to `show`. This must live as long as the hooks.
  void add_to(run::RunHooks& hooks, std::function<void(const Moment&)> show);

 private:
  MomentMaker maker_;
  run::PluginLog& log_;
};

}  // namespace hallway::watch
