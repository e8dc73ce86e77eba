// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/planes.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace hallway::host {

/// How many elements a sample has: points, or planes. Nothing for other kinds.
std::optional<std::uint64_t> count_elements(const hw_sample_t& sample);

/// Planes as they stand in a frame in which the sample that they were found in has the index `sample`. With HW_NO_SAMPLE it is not there;
/// then their members, which are its elements, are left out.
/// @param storage  holds the planes that were changed, if any were
/// @return refers to what `planes` refers to, and to `storage`
hw_planes_t refer_to_sample(const hw_planes_t& planes, std::uint32_t sample,
                            std::vector<hw_plane_t>& storage);

}  // namespace hallway::host
