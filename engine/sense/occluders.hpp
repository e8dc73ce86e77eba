// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "csg/surface.hpp"
#include "trace/triangle_mesh.hpp"

namespace hallway::sense {

/// The surface of a world, polygon by polygon, then the meshes that stand in it, in order, as the triangles that block sight.
trace::TriangleMesh make_occluders(const csg::Surface& surface,
                                   std::span<const trace::TriangleMesh> meshes = {});

}  // namespace hallway::sense
