// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "planes/score.hpp"

namespace hallway::planes {

/// What could be found at best: the planes as they are, each point given to the one that it comes from most
/// likely (or to none), by the rectangles, the noise, the numbers of points and that of outliers. Holes are
/// not known to it. Planes are fitted to the points that they are given. Empty where the truth does not tell
/// rectangles and noise. O(points x planes).
std::vector<PlaneObservation> answer_knowing(const std::vector<Vec3>& points, const Truth& truth);

/// Counts apart, for each IoU, the planes that `knowing`, the score of answer_knowing() on the same truth,
/// does not get right: sets Score::decidable of `score`.
void count_decidable(const Score& knowing, Score& score);

}  // namespace hallway::planes
