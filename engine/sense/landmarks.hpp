// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "csg/surface.hpp"
#include "geometry/se3.hpp"
#include "map/document.hpp"
#include "map/world.hpp"
#include "sense/face_landmarks.hpp"

namespace hallway::sense {

/// A map that asks for more points than this is refused.
inline constexpr std::size_t kMaxLandmarks = 10'000'000;

/// All points of a map that a point sensor may see, in world metres; the index is the landmark's number. First those on the
/// world's surface, in the order of `world`, then those of the clouds in the order of the document (see face_landmarks.hpp
/// and cloud_landmarks.hpp). A pure function of the document and `wanted`; `world` is build_world() of the document and
/// `surface` build_surface() of that. Throws Error{kBadInput} with the map's file and line for bad keys, for a cloud along a
/// path that does not exist, and for more than kMaxLandmarks.
///
/// @param wanted  which polygons of the surface may have points; all if empty
std::vector<Vec3> make_landmarks(const map::Document& document, const map::World& world,
                                 const csg::Surface& surface, const PolygonFilter& wanted = {});

}  // namespace hallway::sense
