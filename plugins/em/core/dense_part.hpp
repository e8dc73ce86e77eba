// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "em/core/candidate.hpp"

namespace hallway::em {

/// How a plane's density is watched.
struct DensityCheck {
  double step = 0.0;   ///< > 0: width of the strips in which points are counted
  double least = 0.0;  ///< share of the density so far that a strip must have
};

/// Keeps of a plane's members those in the dense part around `start` (thesis 3.5.3, step 5): a rectangle about its foot, with the sides of the
/// plane's own, is widened one strip at a time at each side in turn; a side stays where its next strip holds fewer points than `least` of what
/// the density within the rectangle makes expect. Only members change; O(members + strips^2), at most 512 strips each way.
void keep_dense_part(Candidate& plane, std::span<const Vec3> points, const Vec3& start,
                     const DensityCheck& check);

}  // namespace hallway::em
