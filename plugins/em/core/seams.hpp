// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "em/core/mixture.hpp"
#include "em/core/points.hpp"

namespace hallway::em {

/// Points at seams: those of another group of patches that a group explains too. A point is shared if it lies within two
/// standard deviations of the plane of its own patch and of that of its second best one, and these planes meet at 15
/// degrees or more; so points of a surface in facets, or between sheets, are not.
///
/// `groups`: of each patch the first one of its group. For each group, by that patch, its shared places in `points`,
/// ascending. O(points).
std::vector<std::vector<std::uint32_t>> places_at_seams(const Points& points, const Mixture& mixture,
                                                        const std::vector<std::uint32_t>& groups,
                                                        Workers& workers);

}  // namespace hallway::em
