// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "geom/plane.hpp"

namespace hallway::planes {

/// The plane nearest to `points`, at least one, in the sum of squared distances (total least squares: the eigenvector of the least eigenvalue of their
/// second moments about the centroid). Points on a line or in one place leave it open; the answer is then one of the nearest planes. O(n).
Plane least_squares_plane(std::span<const Vec3> points);

}  // namespace hallway::planes
