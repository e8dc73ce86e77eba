// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "slam_plane/thesis/comparison.hpp"

namespace hallway::slam_plane::thesis {

/// How far the middle of a plane moves when it is given another size [m] and its key point stays (Rules 16, 17, 28). Zero for KeyPoint::none.
Vec2 middle_shift(const Vec2& direction, KeyPoint key, double from_size, double to_size);

/// A segment grown (or shrunk) to a size [m], its key point in place. Rule 16: what is seen of a wall, to be compared with the wall's full size. Nothing without a key
/// point, unless it has that size already, but for `tolerance` [m].
std::optional<Segment> resized(const Segment& segment, KeyPoint key, double size, double tolerance = 0.0);

/// The same of a placement.
std::optional<Placement> resized(const Placement& placement, double size, double tolerance = 0.0);

/// Two placements of one plane, in two frames, brought to the larger of both sizes: the smaller one grows from its key point (Rule 17). False, and both as they were, if
/// it has none and the sizes differ by more than `tolerance` [m].
bool bring_to_one_size(Placement& a, Placement& b, double tolerance);

/// Places plane b of a comparison in the frame of `base`, which holds plane a: the sizes of a in both are brought to one before (Rule 28). `base` grows if the comparison saw more of the plane.
/// Not valid if either is not, or the sizes cannot be brought to one.
Placement chained(Placement& base, const Comparison& comparison, double tolerance);

}  // namespace hallway::slam_plane::thesis
