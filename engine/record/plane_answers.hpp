// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "host/plane_lists.hpp"
#include "log/planes.hpp"

namespace hallway::record {

/// Three numbers of the ABI's as tables have them.
inline std::array<double, 3> three(const double (&numbers)[3]) {
  return {numbers[0], numbers[1], numbers[2]};
}

/// A plane as tables have it.
log::Plane plane_row(const hw_plane_t& plane);

/// The planes of a sample as logs have them, in their order.
std::vector<log::PlaneAnswer> plane_answers(const host::PlaneList& list);

}  // namespace hallway::record
