// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/se3.hpp"
#include "map/document.hpp"
#include "map/entities.hpp"

namespace hallway::sense {

/// How many points a cloud has: round(path length * per_100m / 100). Throws as add_cloud_landmarks() does.
std::uint64_t cloud_size(const map::Document& document, const map::LandmarkCloud& cloud);

/// Appends the points of the map's `hw_landmark_cloud` entities, in the order of the document: for each cloud
/// cloud_size() points, each beside a place of the path drawn uniformly by distance,
/// level sideways by up to `sideways_m` and up or down by up to `height_m`, uniformly. Solids are not looked
/// at: a point inside one is never seen.
///
/// The random numbers are keyed by the cloud's seed and name and the point's number in the cloud. Throws
/// Error{kBadInput} for a bad key, a path that does not exist, or more than kMaxLandmarks in all.
void add_cloud_landmarks(const map::Document& document, std::vector<Vec3>& landmarks);

}  // namespace hallway::sense
