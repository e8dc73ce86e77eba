// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "geom/box.hpp"

namespace hallway::trace {

/// Items in groups: group g is `items[begin[g]] ... items[begin[g + 1] - 1]`.
struct Groups {
  std::vector<std::uint32_t> items;
  std::vector<std::uint32_t> begin;  ///< one more than there are groups
};

/// Divides boxes into groups of 1 to `most` that lie together, by binned splits that keep the surfaces of the groups'
/// boxes small (Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007). The same result for the
/// same boxes. O(n log n).
///
/// @param boxes  none empty
/// @param most   at least 1
Groups group_boxes(const std::vector<Box>& boxes, std::uint32_t most);

}  // namespace hallway::trace
