// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "em/core/em1_options.hpp"
#include "em/core/types.hpp"

namespace hallway::em {

/// Algorithm `em1` (thesis 3.5.2): planes start from random points with their two nearest neighbours; every iteration matches all points
/// to all planes, fits all planes anew, merges those that are alike, and drops those with few points or few of their own.
///
/// The result follows from the options and the set of points; points that are not finite are ignored, points given twice count once.
/// O(iterations x points x planes). Throws std::invalid_argument for options out of range.
Extraction extract_em1(std::span<const Vec3> cloud, const Em1Options& options = {});

}  // namespace hallway::em
