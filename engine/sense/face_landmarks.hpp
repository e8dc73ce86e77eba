// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "csg/surface.hpp"
#include "geometry/se3.hpp"
#include "map/document.hpp"
#include "map/world.hpp"

namespace hallway::sense {

/// How far a landmark stands off its face, along the normal; and how far from the face's edges and from everything else
/// that is solid it is at least. Metres.
inline constexpr double kFaceClearance_m = 0.001;

/// Says of a polygon, by its index in csg::Surface::polygons, whether it may have points. An empty one says yes to all.
using PolygonFilter = std::function<bool(std::size_t)>;

/// Appends the static points on the world's surface (thesis 2.4: "each polygon has points statically created").
///
/// Density is worldspawn's key `_points_per_m2`; any entity with brushes may have its own, for the faces that its brushes
/// give to the surface. The plane of each face is cut into squares of one point each, at a random place in its square;
/// those that fall on the surface count, so their number is the density times the area on average. The squares are counted
/// from the world's origin and their random numbers are keyed by (`_point_seed`, plane, square): editing one brush moves no
/// points elsewhere, and neither how a face is cut into polygons nor whether it is of one brush or of several matters.
///
/// Left out are points closer than kFaceClearance_m to the face's edge, where the surface turns, and those that would stand
/// closer than that to another part of the surface.
///
/// @param surface  of `world`, without T-junctions
/// Points stand in the order of solids, faces, and squares. Throws Error{kBadInput} for a bad key, or one that asks for
/// more than kMaxLandmarks in all. O(points * log(polygons)).
void add_face_landmarks(const map::Document& document, const map::World& world, const csg::Surface& surface,
                        const PolygonFilter& wanted, std::vector<Vec3>& landmarks);

}  // namespace hallway::sense
