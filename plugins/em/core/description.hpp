// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "em/core/candidate.hpp"
#include "em/core/sorted_cloud.hpp"

namespace hallway::em {

/// What a search found, in the terms of the cloud that it was given. A point that matches several planes is labelled with the nearest; a
/// plane's centroid, rectangle, hull and RMS are those of all that match it, so that planes that meet at a seam
/// meet in the result. A plane that is the nearest of no point is left out.
Extraction describe(const SortedCloud& cloud, const std::vector<Candidate>& planes);

}  // namespace hallway::em
