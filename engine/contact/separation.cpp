// SPDX-License-Identifier: MIT
#include "contact/separation.hpp"

#include <algorithm>

#include "contact/simplex.hpp"

namespace hallway::contact {
namespace {

constexpr int kMostSteps = 100;
/// What is certified is less than what is computed by this share of the lengths at hand: some 16 roundings.
constexpr double kRounding = 2e-15;

/// A body and a triangle in the body's frame.
class Pair {
 public:
  Pair(const BodyShape& shape, const Pose& pose, const Triangle& triangle) : shape_(shape) {
    const Quat back = pose.q.conjugate();
    double size = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      corners_[i] = back * (triangle[i] - pose.t);
      size = std::max(size, corners_[i].norm());
    }
    slack_ = kRounding * (size + shape.radius());
  }

  Vec3 middle() const { return (corners_[0] + corners_[1] + corners_[2]) / 3.0; }
  double slack() const { return slack_; }

  /// The point of body - triangle that is farthest against a direction.
  DifferencePoint against(const Vec3& normal) const {
    const Vec3 first = shape_.support(-normal);
    const Vec3* second = &corners_[0];
    for (const Vec3& corner : corners_) {
      if (normal.dot(corner) > normal.dot(*second)) second = &corner;
    }
    return {first - *second, first, *second};
  }

 private:
  const BodyShape& shape_;
  Triangle corners_;
  double slack_ = 0.0;
};

/// The best plane found so far.
struct Best {
  double gap = -INFINITY;
  Vec3 normal = Vec3::UnitZ();

  void offer(const Pair& pair, const Vec3& direction) {
    if (direction.isZero(0.0)) return;
    const double found = direction.dot(pair.against(direction).at);
    if (found > gap) {
      gap = found;
      normal = direction;
    }
  }
};

}  // namespace

Separation separate(const BodyShape& shape, const Pose& pose, const Triangle& triangle, const Vec3& towards) {
  const Pair pair(shape, pose, triangle);
  const Vec3 begin = towards.isZero(0.0) ? Vec3(-pair.middle()) : Vec3(pose.q.conjugate() * towards);
  Simplex simplex(pair.against(begin));
  Best best;
  for (int step = 0; step < kMostSteps; ++step) {
    const double distance = simplex.nearest().norm();
    if (distance <= pair.slack()) return {};
    const Vec3 normal = simplex.nearest() / distance;
    const DifferencePoint next = pair.against(normal);
    const double bound = normal.dot(next.at);
    if (bound > best.gap) {
      best.gap = bound;
      best.normal = normal;
    }
    if (distance - bound <= 1e-13 * distance || simplex.has(next)) break;
    const Simplex before = simplex;
    simplex.add(next);
    if (simplex.holds_origin()) return {};
    if (!(simplex.nearest().norm() < distance)) {
      simplex = before;
      break;
    }
  }
  best.offer(pair, simplex.direction());
  Separation found;
  found.gap = std::max(0.0, best.gap - pair.slack());
  found.normal = pose.q * best.normal;
  found.on_body = pose * simplex.on_first();
  found.on_triangle = pose * simplex.on_second();
  return found;
}

double gap_along(const BodyShape& shape, const Pose& pose, const Triangle& triangle, const Vec3& normal) {
  const double body = -shape.extent(pose.q.conjugate() * -normal);
  double reach = -INFINITY, size = 0.0;
  for (const Vec3& corner : triangle) {
    const Vec3 from_body = corner - pose.t;
    reach = std::max(reach, normal.dot(from_body));
    size = std::max(size, from_body.norm());
  }
  return body - reach - kRounding * (size + shape.radius());
}

}  // namespace hallway::contact
