// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "em/core/types.hpp"

namespace hallway::em {

/// Splits planes where their members leave a gap: a plane's members hang together if they lie in squares of half the gap, on a grid on the
/// plane, that touch each other. So what is wider than `gap` separates, what is narrower than half of it does not. The parts keep the plane's
/// equation and exclusive share; those of fewer than `min_points` members are in no plane. Planes are in order of their members again, with
/// their places as ids. O(n log n).
///
/// @param cloud  the points that `found` is of
/// @param gap    above 0, the cloud's own unit
void split_at_gaps(std::span<const Vec3> cloud, double gap, std::size_t min_points, Extraction& found);

}  // namespace hallway::em
