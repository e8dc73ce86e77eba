// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "em/core/em2_options.hpp"
#include "em/core/types.hpp"

namespace hallway::em {

/// Algorithm `em2` (thesis 3.5.3): one plane after the other is grown from a random point that no plane has, by widening its bounds and
/// fitting it again, as far as its points stay dense; it is then merged with those found before. In the end, planes
/// with few points of their own are dropped.
///
/// The result follows from the options and the set of points; points that are not finite are ignored, points given twice count once.
/// Throws std::invalid_argument for options out of range.
Extraction extract_em2(std::span<const Vec3> cloud, const Em2Options& options = {});

}  // namespace hallway::em
