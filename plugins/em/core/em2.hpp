// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "em/core/common_options.hpp"
#include "em/core/types.hpp"

namespace hallway::em {

/// Every tunable of `em2` (thesis 3.5.3). share_points = 0: a point belongs to the first plane that takes it.
struct Em2Options : CommonOptions {
  int max_planes = 10000;  ///< the search ends after so many planes that were grown and kept
  int tries = 50;          ///< it ends after so many random points in a row that gave no plane
  int grow_steps = 100;    ///< a plane is widened so often at most
  double min_density =
      0.4;  ///< a plane ends where its density falls below this share of what it was; 0: no check
  double density_step = 0.0;  ///< width of the strips in which density is watched; 0: 4 x the spacing

  /// Throws std::invalid_argument that names the option, its value and its range.
  void validate() const;
};

/// All options. Defaults are those of a default-made Em2Options.
std::span<const OptionRow<Em2Options>> em2_options();

/// Algorithm `em2` (thesis 3.5.3): one plane after the other is grown from a random point that no plane has, by widening its bounds and
/// fitting it again, as far as its points stay dense; it is then merged with those found before. In the end, planes
/// with few points of their own are dropped.
///
/// The result follows from the options and the set of points; points that are not finite are ignored, points given twice count once.
/// Throws std::invalid_argument for options out of range.
Extraction extract_em2(std::span<const Vec3> cloud, const Em2Options& options = {});

}  // namespace hallway::em
