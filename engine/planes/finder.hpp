// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "host/pipeline.hpp"
#include "import/recording.hpp"
#include "planes/plane.hpp"

namespace hallway::planes {

/// What a plugin made of a cloud.
struct Answer {
  std::vector<PlaneObservation> planes{};
  double ms = 0.0;      ///< wall clock, the plugin's call alone; the median of the calls
  double cpu_ms = 0.0;  ///< the same of the calling thread's CPU time
};

/// Gives clouds to a plugin that finds planes, each as the first frame of a new map.
class PlaneFinder {
 public:
  /// Throws what host::Pipeline throws; Error{kBadInput} for a plugin that does not declare planes among its outputs.
  PlaneFinder(host::StageSpec plugin, std::vector<std::filesystem::path> folders, host::LogSink log,
              std::optional<host::Isolation> isolation);

  const host::PluginInfo& info() const { return pipeline_.facts().front().info; }

  /// Throws PluginFailure; Error{kBadInput} for more points than a frame holds.
  /// @param repeats  how often the plugin is asked, at least 1; the last answer counts
  /// @param image    what the points are pixels of, which the plugin is told
  Answer find(const std::vector<Vec3>& points, unsigned repeats = 1, const import::PixelGrid& image = {});

 private:
  host::Pipeline pipeline_;
};

}  // namespace hallway::planes
