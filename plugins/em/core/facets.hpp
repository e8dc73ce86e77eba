// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "em/core/patch.hpp"
#include "em/core/workers.hpp"

namespace hallway::em {

/// Groups of patches that are facets of one surface which bends a little: they lie side by side, meet without a
/// step, and all points of a group are flat within `bend` times its width (the standard deviation across its
/// plane by the one along its shorter side). For each patch the first one of its group; `places` has each patch's
/// points. Pairs that stay flattest are joined first.
std::vector<std::uint32_t> facet_groups(const Points& points, const std::vector<Patch>& patches,
                                        const std::vector<std::vector<std::uint32_t>>& places, double bend,
                                        Workers& workers);

}  // namespace hallway::em
