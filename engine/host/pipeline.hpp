// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/plugin.hpp"

namespace hallway::host {

/// A value for a plugin's parameter, and where it was said.
struct ParameterSetting {
  std::string name;
  std::string value;
  Where where;
};

/// One plugin of a pipeline.
struct StageSpec {
  std::string plugin;  ///< an id or a file, as find_plugin() takes it
  std::vector<ParameterSetting> parameters;
};

/// Plugins in order, each fed with the samples of the kinds it needs. The last one's outputs are the
/// pipeline's.
class Pipeline {
 public:
  /// Finds, makes, sets and activates the plugins. Before any of them is activated, checks that each kind of
  /// sample that one needs is given by a sensor: Error{kBadInput} names the plugin, the kind and what there
  /// is. Throws what find_plugin() and Plugin throw, and Error{kBadInput} if `stages` is empty.
  Pipeline(std::span<const StageSpec> stages, std::span<const std::filesystem::path> folders,
           std::span<const SensorInfo> sensors, const LogSink& log = {});

  std::size_t size() const { return stages_.size(); }
  Plugin& stage(std::size_t i) { return *stages_[i]; }

  /// Feeds one frame to every plugin, in order. @return the last one's outputs, valid until the next call
  const Outputs& process(const hw_frame_t& frame);
  /// The last plugin's map.  @return valid until the next call
  const Outputs& report(bool refine);
  /// Forgets the maps.
  void reset();
  /// The sum of what the plugins took in the last process(), or the last one in report().
  const CallTime& last_call() const { return last_call_; }

 private:
  std::vector<std::unique_ptr<Plugin>> stages_;
  CallTime last_call_;
};

}  // namespace hallway::host
