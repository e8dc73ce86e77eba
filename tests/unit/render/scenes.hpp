// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "render/picture.hpp"

namespace hallway::render::test {

/// Adds the six faces of a box, normals outward.
void add_box(std::vector<Surface>& out, const Vec3& low, const Vec3& high, Rgb colour);

/// A closed floor of an office with corridor, rooms, ceiling and furniture, 16 m by 10 m, and a run through it.
Picture office();

/// A run along a lemniscate of 1145 m with landmarks around it, without any surface.
Picture figure_eight();

}  // namespace hallway::render::test
