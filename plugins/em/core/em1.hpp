// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "em/core/common_options.hpp"
#include "em/core/types.hpp"

namespace hallway::em {

/// Every tunable of `em1` (thesis 3.5.2). share_points = 0: a point belongs to the nearest of the planes that it fits.
struct Em1Options : CommonOptions {
  int max_iterations = 200;  ///< the search ends after so many iterations
  int patience = 10;         ///< it ends when so many iterations in a row have found nothing new
  int new_planes = 10;       ///< random planes started in an iteration
  int tries = 30;            ///< random points drawn in an iteration to start them from

  /// Throws std::invalid_argument that names the option, its value and its range.
  void validate() const;
};

/// All options. Defaults are those of a default-made Em1Options.
std::span<const OptionRow<Em1Options>> em1_options();

/// Algorithm `em1` (thesis 3.5.2): planes start from random points with their two nearest neighbours; every iteration matches all points
/// to all planes, fits all planes anew, merges those that are alike, and drops those with few points or few of their own.
///
/// The result follows from the options and the set of points; points that are not finite are ignored, points given twice count once.
/// O(iterations x points x planes). Throws std::invalid_argument for options out of range.
Extraction extract_em1(std::span<const Vec3> cloud, const Em1Options& options = {});

}  // namespace hallway::em
