// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geom/pose.hpp"
#include "map/document.hpp"
#include "map/world.hpp"

namespace hallway::sense {

/// How far a landmark stands off its face, along the normal; and how far from the face's edges and from other
/// solids it is at least. Metres.
inline constexpr double kFaceClearance_m = 0.001;

/// Appends the static points on the faces of brushes (thesis 2.4: "each polygon has points statically
/// created").
///
/// Density is worldspawn's key `_points_per_m2`; a func_group may have its own. The plane of each face is cut
/// into squares of one point each, at a random place in its square; those that fall on the face count, so
/// their number is the density times the face's area on average. The squares are counted from the world's
/// origin and their random numbers are keyed by (`_point_seed`, plane, square): editing one brush moves no
/// points elsewhere, and two brushes whose faces continue each other are covered like one.
///
/// Left out are points closer than kFaceClearance_m to the face's edge or to another solid, hence all on
/// faces where solids touch; where faces of two solids coincide, the first solid has the points.
///
/// Throws Error{kBadInput} for a bad key, or one that asks for more than kMaxLandmarks in all. O(solids^2 +
/// points * solids nearby).
void add_face_landmarks(const map::Document& document, const map::World& world, std::vector<Vec3>& landmarks);

}  // namespace hallway::sense
