// SPDX-License-Identifier: MIT
#include "contact/ground.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"

namespace hallway::contact {
namespace {

/// A point this far outside of a triangle is on it, metres: floors have no seams.
constexpr double kSeam = 1e-9;
/// The columns of wheels that tilt are found again at most this often.
constexpr int kMostRounds = 8;

double cross2(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Height of a triangle at a vertical line, if that passes it. Upright triangles have none.
std::optional<double> height_at(const Triangle& triangle, const Vec2& at) {
  std::array<Vec2, 3> corner;
  for (std::size_t i = 0; i < 3; ++i) corner[i] = triangle[i].head<2>() - at;
  const double area = cross2(corner[1] - corner[0], corner[2] - corner[0]);
  std::array<double, 3> part;
  double longest2 = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 &a = corner[(i + 1) % 3], &b = corner[(i + 2) % 3];
    const double length = (b - a).norm();
    longest2 = std::max(longest2, length * length);
    part[i] = cross2(a, b);
    if ((area > 0.0 ? part[i] : -part[i]) < -kSeam * length) return std::nullopt;
  }
  if (!(std::abs(area) > 1e-12 * longest2)) return std::nullopt;
  const double a = triangle[0].z(), b = triangle[1].z(), c = triangle[2].z();
  const double height = a + (part[1] * (b - a) + part[2] * (c - a)) / area;
  return std::clamp(height, std::min({a, b, c}), std::max({a, b, c}));
}

std::optional<double> highest(const Obstacles& obstacles, const std::vector<std::uint32_t>& near,
                              const Vec2& at, double low, double high) {
  std::optional<double> best;
  for (const std::uint32_t index : near) {
    const std::optional<double> height = height_at(obstacles.triangle(index), at);
    if (height && *height >= low - kSeam && *height <= high + kSeam && (!best || *height > *best))
      best = height;
  }
  return best;
}

/// A body's orientation on a floor of that slope, with the heading of `guess`.
Quat orientation(const Quat& guess, const Vec2& slope) {
  if (slope.isZero(0.0) && guess.x() == 0.0 && guess.y() == 0.0) return guess;
  const Vec3 ahead = guess * Vec3::UnitX();
  const Vec2 heading = ahead.head<2>().normalized();
  const Vec3 x = Vec3(heading.x(), heading.y(), slope.dot(heading)).normalized();
  const Vec3 z = Vec3(-slope.x(), -slope.y(), 1.0).normalized();
  Mat3 axes;
  axes << x, z.cross(x), z;
  return Quat(axes).normalized();
}

void check_limits(const GroundLimits& limits) {
  for (const double height : {limits.step_m, limits.ledge_m, limits.clearance_m}) {
    if (!(height >= 0.0 && height <= 10.0))
      throw Error(ErrorCode::kBadInput, "the heights that wheels get over must be between 0 and 10 m");
  }
  if (!(limits.slope_rad >= 0.0 && limits.slope_rad <= 1.0))
    throw Error(ErrorCode::kBadInput, "the greatest slope must be between 0 and 1 rad");
}

}  // namespace

Ground::Ground(const Obstacles& obstacles, Wheels wheels, const GroundLimits& limits)
    : obstacles_(obstacles), wheels_(std::move(wheels)), limits_(limits) {
  check_limits(limits_);
  const std::vector<Vec2>& at = wheels_.at;
  if (at.size() != 3 && at.size() != 4)
    throw Error(ErrorCode::kBadInput, "a body must have three or four wheels");
  for (const Vec2& wheel : at) {
    if (!(wheel.norm() <= 1e3))
      throw Error(ErrorCode::kBadInput, "a wheel must be within 1000 m of its body");
    reach_ = std::max(reach_, wheel.norm());
  }
  const Vec2& centre = wheels_.centre_of_mass;
  for (const auto& three : {std::array<std::size_t, 3>{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}) {
    if (three[2] >= at.size()) continue;
    const Vec2 a = at[three[0]], b = at[three[1]], c = at[three[2]];
    const double area = cross2(b - a, c - a);
    if (!(std::abs(area) > 1e-6)) continue;
    const std::array<double, 3> parts{cross2(b - centre, c - centre) / area,
                                      cross2(c - centre, a - centre) / area,
                                      cross2(a - centre, b - centre) / area};
    if (*std::min_element(parts.begin(), parts.end()) >= -1e-9) carry_.push_back(three);
  }
  if (carry_.empty()) throw Error(ErrorCode::kBadInput, "a body's wheels must carry its centre of mass");
}

std::optional<double> Ground::floor_at(const Vec2& at, double low, double high) const {
  const Vec3 margin = Vec3::Constant(kSeam);
  std::vector<std::uint32_t> near;
  obstacles_.near(Box(Vec3(Vec3(at.x(), at.y(), low) - margin), Vec3(Vec3(at.x(), at.y(), high) + margin)),
                  near);
  return highest(obstacles_, near, at, low, high);
}

std::optional<Ground::Plane> Ground::fit(const std::vector<Vec3>& supports) const {
  std::optional<Plane> best;
  double least = INFINITY;
  for (const auto& three : carry_) {
    const Vec3 &a = supports[three[0]], &b = supports[three[1]], &c = supports[three[2]];
    if (!std::isfinite(a.z() + b.z() + c.z())) continue;
    const Vec3 ab = b - a, ac = c - a;
    const double area = cross2(ab.head<2>(), ac.head<2>());
    Plane plane;
    plane.slope = Vec2(ab.z() * ac.y() - ac.z() * ab.y(), ab.x() * ac.z() - ac.x() * ab.z()) / area;
    plane.height = a.z() - plane.slope.dot(a.head<2>());
    double above = 0.0;
    for (const Vec3& support : supports)
      above = std::max(above, support.z() - plane.height - plane.slope.dot(support.head<2>()));
    if (above <= kSeam) return plane;
    if (above < least) {
      least = above;
      best = plane;
    }
  }
  return best;
}

Stance Ground::stand(const Pose& guess, const GroundLimits& limits) const {
  const double up = std::max(limits.step_m, limits.clearance_m);
  const std::size_t count = wheels_.at.size();
  std::vector<double> height(count);  // where the guess has the wheels
  Box box(guess.t);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 point = guess * Vec3(wheels_.at[i].x(), wheels_.at[i].y(), 0.0);
    height[i] = point.z();
    box.extend(point);
  }
  const Vec3 margin(0.5 * reach_ + kSeam, 0.5 * reach_ + kSeam, kSeam);
  std::vector<std::uint32_t> near;
  obstacles_.near(
      Box(Vec3(box.min() - margin - Vec3(0, 0, limits.ledge_m)), Vec3(box.max() + margin + Vec3(0, 0, up))),
      near);

  Stance stance;
  stance.pose = guess;
  std::vector<Vec3> supports(count, Vec3::Constant(NAN));
  for (int round = 0; round < kMostRounds; ++round) {
    double moved = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 arm = stance.pose.q * Vec3(wheels_.at[i].x(), wheels_.at[i].y(), 0.0);
      const Vec2 at = guess.t.head<2>() + arm.head<2>();
      const std::optional<double> found =
          highest(obstacles_, near, at, height[i] - limits.ledge_m, height[i] + up);
      if ((!found && !limits.may_hang) || (found && *found > height[i] + limits.step_m + kSeam)) {
        stance.fault = found ? GroundFault::kStep : GroundFault::kLedge;
        stance.wheel = i;
        stance.where = Vec3(at.x(), at.y(), found.value_or(height[i]));
        return stance;
      }
      Vec3 support(arm.x(), arm.y(), found.value_or(-INFINITY));
      // A column that goes to and fro over an edge as the body tilts: the wheel stands on the upper side.
      if (round >= 2) support.z() = std::max(support.z(), supports[i].z());
      moved = round == 0 ? 1.0 : std::max(moved, (support - supports[i]).head<2>().norm());
      supports[i] = support;
    }
    if (moved <= 1e-12) break;
    const std::optional<Plane> plane = fit(supports);
    if (!plane) {
      stance.fault = GroundFault::kLedge;
      for (std::size_t i = 0; i < count; ++i) {
        if (!std::isfinite(supports[i].z())) stance.wheel = i;
      }
    } else if (1.0 / std::sqrt(1.0 + plane->slope.squaredNorm()) < std::cos(limits.slope_rad) - 1e-12) {
      stance.fault = GroundFault::kSlope;
      for (std::size_t i = 1; i < count; ++i) {
        if (supports[i].z() - height[i] > supports[stance.wheel].z() - height[stance.wheel]) stance.wheel = i;
      }
    }
    if (stance.fault) {
      const Vec3& at = supports[stance.wheel];
      stance.where = Vec3(guess.t.x() + at.x(), guess.t.y() + at.y(),
                          std::isfinite(at.z()) ? at.z() : height[stance.wheel]);
      return stance;
    }
    stance.pose.q = orientation(guess.q, plane->slope);
    stance.pose.t.z() = plane->height;
  }
  return stance;
}

Stance Ground::settle(const Pose& guess) const {
  GroundLimits limits = limits_;
  limits.step_m = std::max(limits.step_m, reach_ * std::tan(limits.slope_rad) + limits.step_m);
  limits.ledge_m = limits.step_m;
  limits.clearance_m = limits.step_m;
  limits.may_hang = false;
  return stand(guess, limits);
}

}  // namespace hallway::contact
