// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "pvs/bit_matrix.hpp"
#include "pvs/compute.hpp"
#include "pvs/directed_portals.hpp"

namespace hallway::pvs {

/// For each directed portal, the portals that may be seen through it, by portal flow with anti-penumbra
/// clipping.
BitMatrix full_portal_rows(const DirectedPortals& world, const Options& options, Statistics& statistics);

}  // namespace hallway::pvs
