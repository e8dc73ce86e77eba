// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "geom/pose.hpp"
#include "map/document.hpp"
#include "map/world.hpp"

namespace hallway::sense {

/// A map that asks for more points than this is refused.
inline constexpr std::size_t kMaxLandmarks = 10'000'000;

/// All points of a map that a point sensor may see, in world metres; the index is the landmark's number.
/// First those on the faces of brushes, in the order of `world`, then those of the clouds in the order of the
/// document (see face_landmarks.hpp and cloud_landmarks.hpp). A pure function of the document; `world` is
/// build_world() of it. Throws Error{kBadInput} with the map's file and line for bad keys, for a cloud along
/// a path that does not exist, and for more than kMaxLandmarks.
std::vector<Vec3> make_landmarks(const map::Document& document, const map::World& world);

}  // namespace hallway::sense
