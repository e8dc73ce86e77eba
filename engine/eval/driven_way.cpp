// SPDX-License-Identifier: MIT
#include "eval/driven_way.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"

namespace hallway::eval {
namespace {

constexpr double kSameHeading = 0.2588190451025208;  ///< cos 75 degrees
constexpr double kApart_m = 1.0;                     ///< of way between two passes

double lerp(double a, double b, double share) {
  return a + share * (b - a);
}

}  // namespace

Vec2 WayPose::forward() const {
  return {std::cos(pose.yaw_rad), std::sin(pose.yaw_rad)};
}

Vec2 WayPose::right() const {
  return {std::sin(pose.yaw_rad), -std::cos(pose.yaw_rad)};
}

Vec2 WayPose::body(const Vec2& point) const {
  const Vec2 from = point - place();
  return {forward().dot(from), -right().dot(from)};
}

Vec2 WayPose::world(const Vec2& point) const {
  return place() + point.x() * forward() - point.y() * right();
}

PlanarPose planar_part(const Pose& T_world_body) {
  const Vec3 ahead = T_world_body.q * Vec3::UnitX();
  return {T_world_body.t.x(), T_world_body.t.y(), std::atan2(ahead.y(), ahead.x())};
}

void DrivenWay::add(std::int64_t t_ns, const PlanarPose& pose) {
  if (!poses_.empty() && t_ns <= poses_.back().t_ns)
    throw Error(ErrorCode::kInternal, "a true pose is not later than the one before");
  WayPose next{t_ns, pose, 0.0};
  if (!poses_.empty()) {
    const WayPose& last = poses_.back();
    // The yaw is not wrapped, so that it can be interpolated.
    next.pose.yaw_rad =
        last.pose.yaw_rad + std::remainder(next.pose.yaw_rad - last.pose.yaw_rad, 2.0 * std::numbers::pi);
    const double yaw_rad = lerp(last.pose.yaw_rad, next.pose.yaw_rad, 0.5);
    const Vec2 step = next.place() - last.place();
    next.way_m = last.way_m + step.dot(Vec2(std::cos(yaw_rad), std::sin(yaw_rad)));
  }
  poses_.push_back(next);
}

std::optional<WayPose> DrivenWay::at(std::int64_t t_ns) const {
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), t_ns,
                                      [](const WayPose& pose, std::int64_t t) { return pose.t_ns < t; });
  if (after == poses_.end()) return std::nullopt;
  if (after->t_ns == t_ns) return *after;
  if (after == poses_.begin()) return std::nullopt;
  const WayPose &a = *(after - 1), &b = *after;
  const double share = static_cast<double>(t_ns - a.t_ns) / static_cast<double>(b.t_ns - a.t_ns);
  return WayPose{t_ns,
                 {lerp(a.pose.x_m, b.pose.x_m, share), lerp(a.pose.y_m, b.pose.y_m, share),
                  lerp(a.pose.yaw_rad, b.pose.yaw_rad, share)},
                 lerp(a.way_m, b.way_m, share)};
}

std::vector<double> DrivenWay::passes(std::int64_t t_ns, const Vec2& point, double gate_m) const {
  const std::optional<WayPose> own = at(t_ns);
  if (!own) return {};
  const Vec2 place = own->world(point);
  std::vector<double> found{own->way_m};
  const auto is_alike = [&](const WayPose& pose, const Vec2& there) {
    return pose.forward().dot(own->forward()) >= kSameHeading && there.norm() <= point.norm() + gate_m &&
           (there.y() < 0.0) == (point.y() < 0.0);
  };
  for (std::size_t i = 1; i < poses_.size(); ++i) {
    const Vec2 before = poses_[i - 1].body(place), after = poses_[i].body(place);
    if (before.x() <= point.x() || after.x() > point.x() || !is_alike(poses_[i], after)) continue;
    const double share = (before.x() - point.x()) / (before.x() - after.x());
    const double way_m = lerp(poses_[i - 1].way_m, poses_[i].way_m, share);
    const auto is_near = [&](double other) { return std::abs(other - way_m) < kApart_m; };
    if (std::ranges::none_of(found, is_near)) found.push_back(way_m);
  }
  std::ranges::sort(found);
  return found;
}

double DrivenWay::way_abreast(const Vec2& point, std::size_t from) const {
  std::size_t before_it = from;
  while (before_it > 0 && poses_[before_it].body(point).x() <= 0.0) --before_it;
  for (std::size_t i = before_it + 1; i < poses_.size(); ++i) {
    const double before = poses_[i - 1].body(point).x(), after = poses_[i].body(point).x();
    if (before > 0.0 && after <= 0.0)
      return lerp(poses_[i - 1].way_m, poses_[i].way_m, before / (before - after));
  }
  return poses_[from].way_m;
}

}  // namespace hallway::eval
