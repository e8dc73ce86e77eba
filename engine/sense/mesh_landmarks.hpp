// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geometry/se3.hpp"
#include "mesh/placement.hpp"

namespace hallway::sense {

/// Appends points on the triangles of a placed model, as add_face_landmarks() does on brushes: kFaceClearance_m off the front, `per_m2` on each
/// square metre on average. A triangle of area A has floor(per_m2 A) points and one more with the probability of what is left; where they
/// stand is uniform. The random numbers are keyed by (`seed`, placement, triangle). Throws Error{kBadInput} for more than kMaxLandmarks in all.
/// O(triangles + points).
///
/// @param placement  number of the model among those of the map
void add_mesh_landmarks(const mesh::PlacedMesh& mesh, std::uint32_t placement, double per_m2,
                        std::uint64_t seed, std::vector<Vec3>& landmarks);

}  // namespace hallway::sense
