// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "eval/error_statistics.hpp"
#include "eval/pose_pairs.hpp"

namespace hallway::eval {

/// Errors of poses: distances, and angles of the rotations between.
struct PathError {
  std::optional<ErrorStatistics> translation_m;
  std::optional<ErrorStatistics> rotation_deg;
};

/// The absolute trajectory error (ATE, evo's APE): of each pair the distance between the true position and the estimated one where the
/// fit puts it, and the angle between the orientations; no angles where the fit leaves the rotation open. O(n log n).
PathError absolute_error(const Sequence<PosePair>& pairs, const PathFit& fit);

/// How long a stretch of a relative error is.
enum class DeltaUnit { kFrames, kMetres, kSeconds };
struct Delta {
  double value = 1.0;  ///< positive; of frames a whole number
  DeltaUnit unit = DeltaUnit::kFrames;
};

/// A stretch of a path, by the indices of its ends.
struct Stretch {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The stretches of that length from every pair on. Frames: from i to i + value. Metres (travelled along the reference) and seconds: from i to the first j
/// at which `value` is reached, less a millionth for rounding; left out where that is more than twice `value`, which is a gap. O(n).
std::vector<Stretch> stretches(const Sequence<PosePair>& pairs, const Delta& delta);

/// The relative pose error (RPE) over stretches(): of E = (Q_i^-1 Q_j)^-1 (P_i^-1 P_j), Q the reference and P the estimate with its positions times
/// `scale`, the length of the translation and the angle of the rotation. It depends on no alignment. O(n log n).
PathError relative_error(const Sequence<PosePair>& pairs, const Delta& delta, double scale = 1.0);

}  // namespace hallway::eval
