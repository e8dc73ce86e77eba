// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "em/core/candidate.hpp"

namespace hallway::em {

/// When two planes are one.
struct MergeBounds {
  double cos_angle = 1.0;  ///< least cosine of the angle between their normals
  double offset = 0.0;     ///< largest distance of the smaller one's centroid from the larger one
  double gap = 0.0;        ///< largest gap between their rectangles
};

/// Whether the rectangles of two nearly parallel planes overlap, or lie no more than `gap` apart along the sides of both.
bool outlines_meet(const Outline& a, const Outline& b, double gap);

/// Whether two planes are alike in normal and offset, and overlap. The one with more members gives the plane that the other's centroid is
/// compared with: the equation of the smaller one says little far from it.
bool mergeable(const Candidate& a, const Candidate& b, const MergeBounds& bounds);

/// Merges planes until no two are mergeable; the earlier one of two gets the points of both and is fitted to them (thesis 3.5.2, step 8;
/// 3.5.3, step 7).
void merge_alike(std::vector<Candidate>& planes, std::span<const Vec3> points, const MergeBounds& bounds);

}  // namespace hallway::em
