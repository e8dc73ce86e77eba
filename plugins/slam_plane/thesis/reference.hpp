// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/thesis/alignment.hpp"
#include "slam_plane/thesis/comparison.hpp"

namespace hallway::slam_plane::thesis {

/// A plane in a submap's frame, and which of its ends are known to be right (thesis 4.4.3.5).
struct Reference {
  Placement place;
  bool known[2] = {false, false};  ///< ends a and b: static in what the place was made from
  int shared = 0;                  ///< iterations it was compared over

  bool valid() const { return place.valid; }
  /// Both ends are right, and so is the size.
  bool full() const { return known[kEndA] && known[kEndB]; }
};

/// A reference moved into another frame.
Reference moved(const Pose2& T, const Reference& reference);

/// Which ends of plane a (0) or b (1) were static in a comparison: those with a standard deviation close to the least one.
void static_ends(const Comparison& comparison, int which, const CompareOptions& options, bool (&ends)[2]);

/// Plane a (0) or b (1) of a comparison in the frame of a.
Reference reference_of(const Comparison& comparison, int which, const CompareOptions& options);

/// Places plane b of a comparison in the frame of `base`, which holds plane a. Not valid if the two tell of no common end of a.
Reference chained(Reference& base, const Comparison& comparison, const CompareOptions& options);

/// Grows a plane by what another reference of it in the same frame tells: ends that it knows, else a larger size.
void grow(Reference& plane, const Reference& other);

/// One plane's references in two frames as evidence of how the frames lie to each other (Rule 17). Appends one pair for each end that both know, else one for the line alone.
void append_pairs(const Reference& from, const Reference& to, std::vector<PlanePair>& pairs);

}  // namespace hallway::slam_plane::thesis
