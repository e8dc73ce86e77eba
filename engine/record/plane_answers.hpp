// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "host/plane_lists.hpp"
#include "log/planes.hpp"

namespace hallway::record {

/// A plane as tables have it.
log::Plane plane_row(const hw_plane_t& plane);

/// The planes of a sample as logs have them, in their order.
std::vector<log::PlaneAnswer> plane_answers(const host::PlaneList& list);

}  // namespace hallway::record
