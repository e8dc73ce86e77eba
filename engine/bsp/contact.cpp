// SPDX-License-Identifier: MIT
#include "bsp/contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace hallway::bsp {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kParallel = 1e-7;  ///< unit vectors with a smaller cross product count as parallel
constexpr double kRounding = 1e-9;  ///< metres by which features overlap, so that nothing passes between them

/// Half of the directions to the sides of the prism around a cylinder; the others are their opposites.
const std::array<Vec3, 24>& prism_sides() {
  static const std::array<Vec3, 24> sides = [] {
    std::array<Vec3, 24> list;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const double angle = std::numbers::pi * static_cast<double>(i) / static_cast<double>(list.size());
      list[i] = Vec3(std::cos(angle), std::sin(angle), 0.0);
    }
    return list;
  }();
  return sides;
}

/// Calls see(axis) for unit vectors along which an upright body and a face can be separated, until it returns false.
template <typename See>
void visit_axes(const BodyShape& shape, const NearFace& face, See&& see) {
  const auto see_product = [&](const Vec3& a, const Vec3& b) {
    const Vec3 product = a.cross(b);
    const double length = product.norm();
    return length <= kParallel || see(Vec3(product / length));
  };
  if (!see(face.normal) || !see(Vec3(Vec3::UnitZ()))) return;
  const bool round = shape.disc_m > 0.0;
  const Vec3 length = round ? Vec3(Vec3::Zero()) : shape.half_length.normalized();
  const Vec3 width = round ? Vec3(Vec3::Zero()) : shape.half_width.normalized();
  if (!round && (!see(length) || !see(width))) return;
  for (const Vec3& edge : face.edges) {
    if (!see_product(edge, Vec3::UnitZ())) return;
    if (!round && (!see_product(edge, length) || !see_product(edge, width))) return;
  }
  if (!round) return;
  for (const Vec3& side : prism_sides()) {
    if (!see(side)) return;
  }
  for (const Vec3& edge : face.edges) {  // the rims of top and bottom against sloping edges
    if (std::abs(edge.z()) <= kParallel || std::abs(edge.z()) >= 1.0 - kParallel) continue;
    for (const Vec3& side : prism_sides()) {
      if (!see_product(edge, side)) return;
    }
  }
}

/// What of an axis the face covers.
struct Extent {
  double low = kInfinity;
  double high = -kInfinity;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

Extent extent_along(const NearFace& face, const Vec3& axis) {
  Extent extent;
  for (const Vec3& corner : face.corners) extent.add(axis.dot(corner));
  if (axis == face.normal) extent.add(face.offset);  // welded corners may lie beside the plane
  return extent;
}

/// The gap along one axis.
struct AxisGap {
  double above;  ///< from the face to the body, the body being farther along the axis
  double below;  ///< the other way round

  AxisGap(const BodyShape& shape, const NearFace& face, const Vec3& axis) {
    const Extent extent = extent_along(face, axis);
    above = -shape.reach(-axis) - extent.high;
    below = extent.low - shape.reach(axis);
  }
  double distance() const { return std::max(above, below); }
  Gap along(const Vec3& axis) const { return above >= below ? Gap{above, axis} : Gap{below, -axis}; }
};

Gap prism_gap(const BodyShape& shape, const NearFace& face) {
  Gap best{-kInfinity, face.normal};
  visit_axes(shape, face, [&](const Vec3& axis) {
    const AxisGap at(shape, face, axis);
    if (at.distance() > best.distance) best = at.along(axis);
    return true;
  });
  return best;
}

/// Met at the start, if the motion goes deeper.
std::optional<Touch> touch_at_start(const Gap& start, const Vec3& motion) {
  if (motion.dot(start.normal) >= 0.0) return std::nullopt;
  return Touch{0.0, start.normal};
}

/// Separating axes, over time: body and face touch while they overlap along all of them.
std::optional<Touch> prism_touch(const BodyShape& shape, const NearFace& face, const Vec3& motion,
                                 double limit) {
  Gap start{-kInfinity, face.normal};
  Touch entry{-kInfinity, face.normal};
  double exit = kInfinity;
  visit_axes(shape, face, [&](const Vec3& axis) {
    const AxisGap at(shape, face, axis);
    const double speed = axis.dot(motion);
    if (at.distance() > start.distance) start = at.along(axis);
    const double closing = at.above >= at.below ? -speed : speed;
    if (at.distance() > 0.0) {
      const double time = closing > 0.0 ? at.distance() / closing : kInfinity;
      if (time > entry.fraction) entry = {time, at.along(axis).normal};
    }
    if (speed != 0.0) exit = std::min(exit, (speed > 0.0 ? -at.above : -at.below) / std::abs(speed));
    return entry.fraction <= std::min(exit, limit);
  });
  if (entry.fraction > std::min(exit, limit)) return std::nullopt;
  if (start.distance <= 0.0) return touch_at_start(start, motion);
  return entry;
}

/// Distance of a point from a face, and where on it.
Gap point_gap(const NearFace& face, const Vec3& point) {
  const std::size_t n = face.corners.size();
  bool inside = true;
  double best = kInfinity;
  Vec3 away = face.normal;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& a = face.corners[i];
    const Vec3 edge = face.corners[(i + 1) % n] - a;
    if (face.normal.cross(edge).dot(point - a) < 0.0) inside = false;
    const double along = std::clamp((point - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    const Vec3 offset = point - (a + along * edge);
    if (offset.norm() < best) {
      best = offset.norm();
      away = offset;
    }
  }
  const double height = face.normal.dot(point) - face.offset;
  if (inside) return {std::abs(height), height < 0.0 ? Vec3(-face.normal) : face.normal};
  if (best == 0.0) return {0.0, face.normal};
  return {best, away / best};
}

/// The earlier time at which a point that starts at `start` and moves by `motion` is `radius` from the origin; infinite if it never
/// comes so near. Computed from the place of closest approach, which keeps the precision of far starts.
double time_within(const Vec3& start, const Vec3& motion, double radius) {
  const double speed2 = motion.squaredNorm();
  if (speed2 == 0.0) return kInfinity;
  const double closest = -start.dot(motion) / speed2;
  const double slack2 = radius * radius - (start + closest * motion).squaredNorm();
  if (slack2 < 0.0) return kInfinity;
  return closest - std::sqrt(slack2 / speed2);
}

/// Contacts of a moving ball: with the inside of the face, with its edges, with its corners.
class BallTouch {
 public:
  BallTouch(const NearFace& face, double radius, const Vec3& motion, double limit)
      : face_(face), radius_(radius), motion_(motion), time_(limit) {}

  std::optional<Touch> find() {
    for (const double side : {1.0, -1.0}) meet_inside(side);
    for (std::size_t i = 0; i < face_.corners.size(); ++i) {
      meet_edge(face_.corners[i], face_.corners[(i + 1) % face_.corners.size()]);
      meet_corner(face_.corners[i]);
    }
    if (!found_) return std::nullopt;
    const Gap at = point_gap(face_, time_ * motion_);
    return Touch{time_, at.normal};
  }

 private:
  void offer(double time) {
    if (!(time >= 0.0) || time > time_) return;
    time_ = time;
    found_ = true;
  }

  void meet_inside(double side) {
    const double closing = -side * face_.normal.dot(motion_);
    if (closing <= 0.0) return;
    const double time = (-side * face_.offset - radius_) / closing;
    const Vec3 point = time * motion_;
    const std::size_t n = face_.corners.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 edge = face_.corners[(i + 1) % n] - face_.corners[i];
      if (face_.normal.cross(edge).dot(point - face_.corners[i]) < -kRounding * edge.norm()) return;
    }
    offer(time);
  }

  void meet_edge(const Vec3& a, const Vec3& b) {
    const double length = (b - a).norm();
    const Vec3 along = (b - a) / length;
    const Vec3 start = -a - along * along.dot(-a);
    const double time = time_within(start, motion_ - along * along.dot(motion_), radius_);
    const double place = along.dot(time * motion_ - a);
    if (place >= -kRounding && place <= length + kRounding) offer(time);
  }

  void meet_corner(const Vec3& corner) { offer(time_within(-corner, motion_, radius_)); }

  const NearFace& face_;
  double radius_;
  const Vec3& motion_;
  double time_;  ///< the earliest contact so far, or the limit
  bool found_ = false;
};

Gap ball_gap(const BodyShape& shape, const NearFace& face) {
  Gap found = point_gap(face, Vec3::Zero());
  found.distance -= shape.ball_m;
  return found;
}

}  // namespace

bool load(const csg::Surface& surface, const csg::SurfacePolygon& polygon, const Vec3& position,
          NearFace& face) {
  const std::size_t n = polygon.vertices.size();
  if (n < 3) return false;
  face.normal = polygon.plane.normal;
  face.offset = -polygon.plane.distance(position);
  face.corners.clear();
  face.edges.clear();
  for (const std::uint32_t vertex : polygon.vertices)
    face.corners.push_back(surface.vertices[vertex] - position);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 edge = (face.corners[(i + 1) % n] - face.corners[i]).normalized();
    if (face.edges.empty() || face.edges.back().cross(edge).norm() > kParallel) face.edges.push_back(edge);
  }
  return true;
}

Gap gap(const BodyShape& shape, const NearFace& face) {
  return shape.ball_m > 0.0 ? ball_gap(shape, face) : prism_gap(shape, face);
}

std::optional<Touch> first_touch(const BodyShape& shape, const NearFace& face, const Vec3& motion,
                                 double limit) {
  if (shape.ball_m <= 0.0) return prism_touch(shape, face, motion, limit);
  const Gap start = ball_gap(shape, face);
  if (start.distance <= 0.0) return touch_at_start(start, motion);
  return BallTouch(face, shape.ball_m, motion, limit).find();
}

}  // namespace hallway::bsp
