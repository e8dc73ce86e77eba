// SPDX-License-Identifier: MIT
#include "contact/fall.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::contact {
namespace {

/// What is not this much lower is no fall, metres.
constexpr double kLeastFall = 1e-3;

/// The orientation of a body that is level, with the heading of a pose.
Quat level(const Quat& q) {
  const Vec3 ahead = q * Vec3::UnitX();
  return from_yaw_pitch_roll(std::atan2(ahead.y(), ahead.x()), 0.0, 0.0);
}

}  // namespace

std::optional<Stance> stance_below(const Ground& ground, const Pose& guess, double depth) {
  // The floor may rise or fall towards the wheels, and there may be none at the body's middle.
  std::optional<double> floor = ground.floor_at(guess.t.head<2>(), guess.t.z() - depth, guess.t.z());
  for (const Vec2& wheel : ground.wheels().at) {
    if (floor) break;
    const Vec3 at = guess * Vec3(wheel.x(), wheel.y(), 0.0);
    floor = ground.floor_at(at.head<2>(), guess.t.z() - depth, guess.t.z());
  }
  if (!floor) return std::nullopt;
  return ground.settle({level(guess.q), Vec3(guess.t.x(), guess.t.y(), *floor)});
}

Fall fall_over(const BodyShape& shape, const Ground& ground, SweepCheck& check, const Pose& pose,
               const Vec3& way) {
  Fall fall;
  const Vec3 flat(way.x(), way.y(), 0.0);
  if (!(flat.norm() > 0.0)) return fall;
  const Vec3 step = flat.normalized() * kLongestPart;
  const int steps = std::max(1, static_cast<int>(std::ceil(2.0 * shape.radius() / kLongestPart)));
  bool over_nothing = false;
  for (int i = 0; i <= steps; ++i) {
    const Pose out{pose.q, pose.t + i * step};
    if (check.blocker(make_drop(0, pose, out), kClearance)) break;
    const auto down = stance_below(ground, out, kDeepestFall);
    over_nothing = over_nothing || !down;
    if (!down || down->fault || down->pose.t.z() >= pose.t.z() - kLeastFall) continue;
    if (check.blocker(make_drop(0, out, down->pose), kClearance)) continue;
    fall.poses = {out, down->pose};
    fall.height_m = pose.t.z() - down->pose.t.z();
    return fall;
  }
  fall.is_lost = over_nothing;
  return fall;
}

}  // namespace hallway::contact
