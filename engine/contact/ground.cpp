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
/// A wheel that does not carry hangs over the floor by at most this share of the greatest depth. So a body that tips back onto it goes down by less than that,
/// and a place that was reached can be left.
constexpr double kHangingShare = 0.9;

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

std::optional<std::size_t> Ground::over_ledge(const Plane& plane, const std::vector<Vec3>& supports,
                                              const std::vector<double>& before,
                                              const GroundLimits& limits) const {
  if (limits.may_hang) return std::nullopt;
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const double above = plane.height + plane.slope.dot(supports[i].head<2>()) - supports[i].z();
    if (above > kHangingShare * limits_.ledge_m + kSeam) return i;
    if (above <= kSeam && before[i] - supports[i].z() > limits.ledge_m + kSeam) return i;
  }
  return std::nullopt;
}

Stance Ground::stand(const Pose& guess, const GroundLimits& limits) const {
  const std::size_t count = wheels_.at.size();
  const double up = std::max(limits.step_m, limits.clearance_m);
  // A wheel that does not carry may be above what `guess` says, and its floor below that by more than `ledge_m`.
  const double down = limits.may_hang ? limits.ledge_m : 2.0 * limits.ledge_m + 1e-3;
  const Vec3 normal = guess.q * Vec3::UnitZ();
  const Vec2 ahead = (guess.q * Vec3::UnitX()).head<2>().normalized();
  std::vector<Vec3> supports(count);  // from the body's origin, but for their z
  std::vector<double> before(count);  // where the guess has the wheels
  Box box;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2& wheel = wheels_.at[i];
    const Vec2 arm = wheel.x() * ahead + wheel.y() * Vec2(-ahead.y(), ahead.x());
    before[i] = guess.t.z() - normal.head<2>().dot(arm) / normal.z();
    supports[i] = Vec3(arm.x(), arm.y(), 0.0);
    box.extend(Vec3(guess.t.x() + arm.x(), guess.t.y() + arm.y(), before[i]));
  }
  const Vec3 seam = Vec3::Constant(kSeam);
  std::vector<std::uint32_t> near;
  obstacles_.near(Box(Vec3(box.min() - seam - Vec3(0, 0, down)), Vec3(box.max() + seam + Vec3(0, 0, up))),
                  near);

  Stance stance;
  stance.pose = guess;
  const auto refuse = [&](GroundFault fault, std::size_t wheel, double z) {
    stance.fault = fault;
    stance.wheel = wheel;
    stance.where = Vec3(guess.t.x() + supports[wheel].x(), guess.t.y() + supports[wheel].y(), z);
    return stance;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const auto found = highest(obstacles_, near, guess.t.head<2>() + supports[i].head<2>(), before[i] - down,
                               before[i] + up);
    if (!found && !limits.may_hang) return refuse(GroundFault::kLedge, i, before[i]);
    if (found && *found > before[i] + limits.step_m + kSeam) return refuse(GroundFault::kStep, i, *found);
    supports[i].z() = found.value_or(-INFINITY);
  }
  const std::optional<Plane> plane = fit(supports);
  if (!plane) {
    const auto hangs = std::ranges::find_if(supports, [](const Vec3& at) { return !std::isfinite(at.z()); });
    const auto wheel = static_cast<std::size_t>(hangs - supports.begin());
    return refuse(GroundFault::kLedge, wheel, before[wheel]);
  }
  if (const auto over = over_ledge(*plane, supports, before, limits))
    return refuse(GroundFault::kLedge, *over, before[*over]);
  if (1.0 / std::sqrt(1.0 + plane->slope.squaredNorm()) < std::cos(limits.slope_rad) - 1e-12) {
    std::size_t wheel = 0;
    for (std::size_t i = 1; i < count; ++i) {
      if (supports[i].z() - before[i] > supports[wheel].z() - before[wheel]) wheel = i;
    }
    return refuse(GroundFault::kSlope, wheel,
                  std::isfinite(supports[wheel].z()) ? supports[wheel].z() : before[wheel]);
  }
  stance.pose.q = orientation(guess.q, plane->slope);
  stance.pose.t.z() = plane->height;
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
