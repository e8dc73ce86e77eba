// SPDX-License-Identifier: MIT
#include "contact/obstacles.hpp"

#include <utility>

#include "base/error.hpp"

namespace hallway::contact {
namespace {

std::vector<Box> boxes_of(const std::vector<Triangle>& triangles) {
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (const Triangle& triangle : triangles) {
    Box box;
    for (const Vec3& corner : triangle) {
      if (!corner.allFinite() || corner.cwiseAbs().maxCoeff() > kGreatestCoordinate)
        throw Error(ErrorCode::kBadInput, "an obstacle's corners must be within 1000 km of the origin");
      box.extend(corner);
    }
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace

Obstacles::Obstacles(std::vector<Triangle> triangles)
    : triangles_(std::move(triangles)), boxes_(boxes_of(triangles_)), tree_(boxes_) {}

}  // namespace hallway::contact
