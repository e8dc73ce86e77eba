// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "geometry/se3.hpp"

namespace hallway::map {

/// The directions in which a texture's columns and rows run over a face, in the map frame; not always of unit length
/// within the face, since they lie in the coordinate plane that the face is nearest to.
struct TextureAxes {
  Vec3 u;
  Vec3 v;
};

/// What the Standard format leaves unsaid: the axes are those of the coordinate plane nearest to the face (of equally near
/// ones: level before facing x before facing y, and up before down, east before west, north before south), turned by
/// the rotation. This is the rule of QuakeEd and of Quake's compilers, which the textures of Standard maps are made for.
///
/// @param points        clockwise as seen from outside; those that make no plane count as a floor
/// @param rotation_deg  a multiple of 90 turns exactly
TextureAxes standard_axes(const std::array<Vec3, 3>& points, double rotation_deg);

}  // namespace hallway::map
