// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "em/core/common_options.hpp"

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

}  // namespace hallway::em
