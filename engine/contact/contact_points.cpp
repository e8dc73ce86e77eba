// SPDX-License-Identifier: MIT
#include "contact/contact_points.hpp"

namespace hallway::contact {

std::vector<ContactPoint> contact_points(const BodyShape& shape, const Pose& pose, const Obstacles& obstacles,
                                         std::uint32_t obstacle, double range) {
  const Triangle& triangle = obstacles.triangle(obstacle);
  const Separation nearest = separate(shape, pose, triangle);
  if (nearest.gap <= 0.0 || nearest.gap > range) return {};
  const Vec3& normal = nearest.normal;
  std::vector<ContactPoint> found{{nearest.on_body, nearest.on_triangle, normal, nearest.gap, obstacle}};
  if (shape.vertices().empty()) return found;  // round: it has no flat sides
  const double angle = range / shape.radius();
  for (const double side : {1.0, -1.0}) {
    // Moved off by as much as it turns at most, so that it stays apart.
    const Quat turn(1.0, 0.0, 0.0, 0.5 * side * angle);
    const Pose turned{(pose.q * turn).normalized(), pose.t + range * normal};
    const Separation end = separate(shape, turned, triangle, normal);
    if (end.gap <= 0.0) continue;
    const Vec3 on_body = pose * (turned.inverse() * end.on_body);
    const double gap = normal.dot(on_body - end.on_triangle);
    if (gap <= range) found.push_back({on_body, end.on_triangle, normal, gap, obstacle});
  }
  return found;
}

}  // namespace hallway::contact
