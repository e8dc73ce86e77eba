// SPDX-License-Identifier: MIT
#pragma once

#include "map/world.hpp"
#include "trace/triangle_mesh.hpp"

namespace hallway::sense {

/// The faces of all solids of a world, in order, as the triangles that block sight.
trace::TriangleMesh make_occluders(const map::World& world);

}  // namespace hallway::sense
