// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "eval/pose_pairs.hpp"

namespace hallway::eval {

/// What is to be thought of an estimated path; docs/metrics.md states the rule.
enum class PathVerdict {
  kOk,
  kDiverged,  ///< somewhere the estimate is not where the robot was
  kLost,      ///< for too long there is no pose, or none in the part of the map that is scored
};

/// "ok", "diverged", "lost".
const char* name_of(PathVerdict verdict);

/// How far an estimate is off at its worst, after the best fit of the positions, beside what counts as diverged.
struct Divergence {
  double limit_m = 0.0;  ///< a twentieth of extent_of() the true path, or more: see divergence_of()
  double worst_m = 0.0;  ///< largest error of a position
  std::optional<double>
      worst_deg;  ///< largest error of an orientation after the best single rotation; where it is judged
  std::optional<std::size_t> first;  ///< the first pair that is over a limit, by index

  bool diverged() const { return first.has_value(); }

  static constexpr double kShareOfExtent = 0.05;
  static constexpr double kLeastLimit_m = 0.1;
  static constexpr double kNoises = 10.0;
  static constexpr double kLimit_deg = 30.0;
};

/// Twice the largest distance of a true position from the mean of all, metres; 0 of none.
double extent_of(const Sequence<Vec3>& path);

/// What is judged of a path: `kAll` for an estimate of the body whose true poses are given. Of other programs' files the bodies may differ
/// by a turn that nobody states.
enum class Judged { kPositions, kAll };

/// @param extent_m  of the whole true path, also where there are no pairs: the limit is the same for all estimates of it
/// @param fit      kRigid, or kSimilarity for an estimate without scale
/// @param noise_m  of the sensor, standard deviation; 0 where it is not known. Ten times as much is within the limit, for a robot at rest shakes
/// @return empty for fewer than three pairs. O(n).
std::optional<Divergence> divergence_of(const Sequence<PosePair>& pairs, double extent_m, Judged judged,
                                        Alignment fit = Alignment::kRigid, double noise_m = 0.0);

/// How many frames have a pose, and where.
struct PoseCount {
  std::uint64_t frames = 0;       ///< of the run
  std::uint64_t scored = 0;       ///< with a pose in the part that is scored
  std::uint64_t other_parts = 0;  ///< with a pose in another part
  bool ends_in_scored = true;     ///< the last pose is in the part that is scored
  std::uint64_t last_scored = 0;  ///< the last frame with a pose in that part

  bool map_forgotten =
      false;  ///< more than half of the associated observations are of landmarks that the map at the end does not have

  /// Fewer than half of the frames have a pose in the scored part, more than one in twenty have one in another part, the last
  /// pose is in another part, none of the last tenth of the frames has a pose in the scored part, or the map was forgotten.
  bool lost() const;
};

/// Diverged goes before lost. Empty where nothing is true of the poses and the robot was not lost.
std::optional<PathVerdict> judge(const PoseCount& count, const std::optional<Divergence>& divergence);

}  // namespace hallway::eval
