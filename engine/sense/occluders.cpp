// SPDX-License-Identifier: MIT
#include "sense/occluders.hpp"

namespace hallway::sense {

trace::TriangleMesh make_occluders(const map::World& world) {
  trace::TriangleMesh mesh;
  for (const map::Solid& solid : world.solids) {
    for (const map::SolidFace& face : solid.faces) mesh.add_polygon(face.polygon);
  }
  return mesh;
}

}  // namespace hallway::sense
