// SPDX-License-Identifier: MIT
#include "sense/landmarks.hpp"

#include "sense/cloud_landmarks.hpp"

namespace hallway::sense {

std::vector<Vec3> make_landmarks(const map::Document& document, const map::World& world,
                                 const csg::Surface& surface, const PolygonFilter& wanted) {
  std::vector<Vec3> landmarks;
  add_face_landmarks(document, world, surface, wanted, landmarks);
  add_cloud_landmarks(document, landmarks);
  return landmarks;
}

}  // namespace hallway::sense
