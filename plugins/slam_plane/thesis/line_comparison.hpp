// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/thesis/comparison.hpp"

namespace hallway::slam_plane::thesis {

/// Where plane b's line lies relative to an end of plane a, from the newest shared sightings: of a plane that is cut on both sides nothing else can be told. Valid if the end's distance from
/// that line stood still, judged by how it jumps from sighting to sighting. It has no key point of b. O(1): of at most 64 iterations.
Comparison compare_line(const Track& a, const Track& b, int end_of_a, Iteration now,
                        const CompareOptions& options);

}  // namespace hallway::slam_plane::thesis
