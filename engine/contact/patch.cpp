// SPDX-License-Identifier: MIT
#include "contact/patch.hpp"

#include "geometry/convex2.hpp"

namespace hallway::contact {
namespace {

constexpr double kNear_m = 1e-3;

/// Points of a body that may be at a plane: the corners of a polytope, the ends of the line along a cylinder's side.
std::vector<Vec3> candidates(const BodyShape& shape, const Vec3& towards) {
  if (!shape.vertices().empty()) return shape.vertices();
  constexpr double kUp = 1e-12;
  return {shape.support({towards.x(), towards.y(), kUp}), shape.support({towards.x(), towards.y(), -kUp})};
}

/// What of a polygon lies where normal . x >= offset.
std::vector<Vec3> part_above(const std::vector<Vec3>& polygon, const Vec3& normal, double offset) {
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = normal.dot(a) - offset, db = normal.dot(b) - offset;
    if (da >= 0.0) kept.push_back(a);
    if (da * db < 0.0) kept.push_back(a + (da / (da - db)) * (b - a));
  }
  return kept;
}

}  // namespace

std::vector<Vec3> contact_patch(const BodyShape& shape, const Pose& pose, const Triangle& triangle,
                                const Vec3& point, const Vec3& normal) {
  const double at = normal.dot(point);
  const PlaneAxes axes(normal);
  std::vector<Vec2> touching;
  for (const Vec3& corner : candidates(shape, pose.q.conjugate() * -normal)) {
    const Vec3 placed = pose * corner;
    if (normal.dot(placed) <= at + kNear_m) touching.push_back(axes.flat(placed));
  }
  const std::vector<Vec3> near = part_above({triangle.begin(), triangle.end()}, normal, at - kNear_m);
  const Convex other = convex_hull(axes.flat(std::span<const Vec3>(near)));
  Convex common = touching.empty() ? Convex() : convex_hull(std::move(touching));
  for (std::size_t i = 0; i < other.size() && other.size() > 2; ++i) {
    const Vec2 edge = other[(i + 1) % other.size()] - other[i];
    const Vec2 out(edge.y(), -edge.x());
    common = clip(common, out, out.dot(other[i]));
  }
  if (common.empty() || other.size() < 3) return {point};
  return axes.lift(common, at);
}

}  // namespace hallway::contact
