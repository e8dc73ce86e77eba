// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "eval/consistency.hpp"
#include "eval/path_error.hpp"
#include "eval/path_verdict.hpp"
#include "eval/plane_metrics.hpp"

namespace hallway::eval {

/// A root mean square error, with the map put into the world in two ways. Empty where it cannot be computed.
struct AlignedRmse {
  /// The map stands so that the first estimate coincides with the true pose of its iteration.
  std::optional<double> first_pose;
  /// After the best fit to the truth; what fits what is said at each use.
  std::optional<double> aligned;
};

/// What one iteration took, over all iterations; milliseconds. Percentiles by nearest rank: the p-th is the smallest value
/// that at least p % of the values do not exceed.
struct TimeSummary {
  double mean = 0.0;
  double p50 = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};

/// A part of a whole; empty where the whole is nothing.
inline std::optional<double> share(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

/// How the true landmarks that move were told from those that stand. A true landmark is marked when more of its observations
/// were given to landmarks of the map with the status dynamic than to mapped ones.
struct MovingMetrics {
  std::uint64_t moved = 0;          ///< true landmarks that moved far enough while they were seen long enough
  std::uint64_t moved_marked = 0;   ///< of those, marked
  std::uint64_t marked = 0;         ///< true landmarks that are marked
  std::uint64_t marked_moving = 0;  ///< of those, such as do not stand still

  std::optional<double> recall() const { return share(moved_marked, moved); }
  std::optional<double> precision() const { return share(marked_moving, marked); }
};

/// The connected parts of a map that poses are in, as the plugin says (`map_epoch`).
struct MapParts {
  std::uint64_t count = 0;     ///< parts with a pose; such as were joined count as one
  std::uint64_t restarts = 0;  ///< how often a pose was in a new part
  std::uint64_t scored_iterations =
      0;  ///< iterations with a pose in the part that is scored: the one with the most
  std::uint64_t other_iterations = 0;  ///< iterations with a pose in another part
  bool ends_in_scored = true;  ///< the last pose, and with it the map at the end, is of the scored part
};

/// How well a run was estimated; docs/metrics.md defines each member. What cannot be computed is empty, never zero.
struct Metrics {
  std::uint64_t iterations = 0;
  std::uint64_t observations = 0;
  /// Iterations without an estimated pose; empty where no plugin has poses to give.
  std::optional<std::uint64_t> lost_iterations = 0;

  std::optional<PathVerdict> verdict;    ///< empty where the true path is not known, or no plugin gives poses
  std::optional<Divergence> divergence;  ///< from three pairs of poses on
  std::optional<std::uint64_t> diverged_at;  ///< the first iteration over a limit
  MapParts parts;                            ///< what is said of poses below is of the scored part alone

  /// Share of the iterations with a pose in the scored part; empty without iterations, and where no plugin gives poses.
  std::optional<double> pose_coverage() const {
    if (!lost_iterations) return std::nullopt;
    return share(parts.scored_iterations, iterations);
  }
  /// Share of the observed true landmarks that own a mapped one; empty where that is not known, where there are none, and where
  /// what was mapped are planes.
  std::optional<double> landmark_coverage() const {
    if (planes && landmarks_mapped == 0) return std::nullopt;
    if (!landmarks_true || !landmarks_missed) return std::nullopt;
    return share(*landmarks_true - *landmarks_missed, *landmarks_true);
  }
  /// Share of the true planes asked for that own a landmark, map as re-solved at the end; empty likewise.
  std::optional<double> wall_coverage() const {
    if (!planes) return std::nullopt;
    return share(planes->refined.walls_mapped, planes->walls_true);
  }

  std::optional<std::uint64_t> landmarks_true;  ///< different true landmarks among the observations; here
                                                ///< and below without those that move
  std::uint64_t landmarks_mapped = 0;           ///< landmarks of the online map with the status mapped
  std::optional<std::uint64_t> landmarks_duplicated;  ///< mapped ones beyond the first of each true landmark
  std::optional<std::uint64_t> landmarks_missed;  ///< observed true landmarks that no mapped one belongs to
  std::optional<std::uint64_t> landmarks_unmatched;  ///< mapped ones that belong to no true landmark

  std::optional<MovingMetrics> moving;  ///< online map; where the truth says what moves

  std::optional<std::uint64_t>
      association_errors;  ///< misassociated observations: with another true landmark's
  std::optional<std::uint64_t>
      associations_dropped;  ///< associated with landmarks that the online map does not have any more
  std::uint64_t associations_none = 0;  ///< unassociated observations

  std::uint64_t landmark_pairs = 0;  ///< what landmark_rmse_m is taken over
  AlignedRmse landmark_rmse_m;       ///< online map; aligned: landmarks fitted rigidly
  std::optional<double>
      landmark_rmse_final_aligned_m;  ///< map as re-solved at the end, landmarks fitted rigidly

  std::uint64_t position_pairs = 0;  ///< iterations with both a true and an estimated pose
  AlignedRmse position_rmse_m;       ///< aligned: positions fitted rigidly (ATE)
  std::uint64_t position_refitted_pairs =
      0;  ///< iterations with a true pose that the map at the end places anew
  std::optional<double> position_rmse_refitted_aligned_m;  ///< of those, positions fitted rigidly
  std::optional<double> position_final_m;  ///< error of the last estimate, in the frame of first_pose
  AlignedRmse rotation_rmse_deg;           ///< aligned: orientations fitted by one rotation
  PathError rpe_frame;                     ///< relative pose error from frame to frame
  PathError rpe_metre;                     ///< over one metre of the true path
  PathError rpe_second;                    ///< over one second

  Consistency landmark_consistency;  ///< map as re-solved at the end, after the fit of its landmarks
  Consistency pose_consistency;      ///< poses as answered, after the fit of the online map's landmarks

  std::optional<PlaneMetrics> planes;  ///< where the true planes are known and the pipeline maps planes

  std::optional<TimeSummary> iteration_ms;      ///< wall clock
  std::optional<TimeSummary> iteration_cpu_ms;  ///< thread's CPU time
};

}  // namespace hallway::eval
