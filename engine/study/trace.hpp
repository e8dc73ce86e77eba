// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "eval/metrics.hpp"
#include "geometry/se3.hpp"
#include "host/pipeline.hpp"
#include "log/map_landmarks.hpp"
#include "run/sources/source.hpp"

namespace hallway::study {

/// One iteration of a run.
struct TraceStep {
  std::uint32_t visible = 0;       ///< points
  double cpu_ms = 0.0;             ///< CPU time of the plugin
  std::optional<Vec3> truth{};     ///< position, world
  std::optional<Vec3> estimate{};  ///< position, map frame
};

/// The online map at some moment, against the truth.
struct MapSample {
  std::uint32_t iterations = 0;  ///< before it
  std::uint64_t mapped = 0;      ///< landmarks with the status mapped
  /// Sum of the distances between mapped landmarks and true ones, the map placed by its first pose (thesis 6.5.5).
  std::optional<double> error_sum_m{};
  std::optional<double> rmse_first_pose_m{};
  std::optional<double> rmse_aligned_m{};  ///< after the best rigid fit
};

/// A number that a plugin counts, over the iterations in which it did.
struct CounterMean {
  std::string name{};
  double mean = 0.0;
  double last = 0.0;
};

/// What a run gave, iteration by iteration.
struct Trace {
  std::vector<TraceStep> steps{};
  std::vector<MapSample> samples{};
  eval::Metrics metrics{};
  std::optional<Pose> T_world_map{};    ///< by the first pose; where the truth has orientations
  std::vector<CounterMean> counters{};  ///< in the order of their first appearance
  std::vector<log::MapLandmark> map{};  ///< as asked for at the end
  std::string failure{};                ///< of the plugin; empty for none
  bool stopped = false;                 ///< by the hook

  /// Error of the estimated position in an iteration, world axes, metres, the map placed by its first pose; empty where there is none.
  std::optional<Vec3> position_error(std::size_t iteration) const;
};

/// What the caller is told and asked.
struct TraceHooks {
  std::function<void()> progress{};  ///< after each iteration
  std::function<bool()> stop{};      ///< true: ends the run
};

/// Feeds a source to a pipeline that was not started, as `hallway run` does, one frame at a time, and looks at the map every `sample_every`
/// iterations (at least 1) and at the end. A plugin that fails ends the run. Memory grows with the iterations.
Trace trace_run(run::Source& source, host::Pipeline& pipeline, std::uint32_t sample_every,
                const TraceHooks& hooks);

}  // namespace hallway::study
