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

/// An observation in its robot's frame; no end is known.
Reference reference_of(const TimedObservation& observation);

/// A reference moved into another frame.
Reference moved(const Pose2& T, const Reference& reference);

/// Plane a (0) or b (1) of a comparison in the frame of a. The end that it was made from is known, if there is one.
Reference reference_of(const Comparison& comparison, int which);

/// Places plane b of a comparison in the frame of `base`, which holds plane a: from the end of a that it was made from, so that it does not matter at what sizes a was seen (Rule 28). Not valid
/// if base does not know that end.
Reference chained(const Reference& base, const Comparison& comparison);

/// Grows a plane by what another reference of it in the same frame tells: ends that it knows, else a larger size.
void grow(Reference& plane, const Reference& other);

/// One plane's references in two frames as evidence of how the frames lie to each other (Rule 17). Appends one pair for each end that both know, else one for the line alone.
void append_pairs(const Reference& from, const Reference& to, std::vector<PlanePair>& pairs);

}  // namespace hallway::slam_plane::thesis
