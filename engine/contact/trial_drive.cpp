// SPDX-License-Identifier: MIT
#include "contact/trial_drive.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::contact {
namespace {

/// Every part of a trial takes that long.
constexpr std::int64_t kTrialPart_ns = 20'000'000;
constexpr double kTrialPart_s = 1e-9 * static_cast<double>(kTrialPart_ns);
/// The way that is left is none below this, metres.
constexpr double kArrived = 1e-9;

GroundLimits limits_without_falls(GroundLimits limits) {
  limits.may_hang = false;
  return limits;
}

}  // namespace

TrialDrive::TrialDrive(const Obstacles& obstacles, const RobotSpec& spec)
    : shape_(spec.shape),
      ground_(obstacles, spec.wheels, limits_without_falls(spec.ground)),
      check_(shape_, obstacles) {}

std::optional<Pose> TrialDrive::stand(const Pose& guess) {
  const Stance stance = ground_.stand(guess);
  if (stance.fault || !check_.within(stance.pose, kClearance).empty()) return std::nullopt;
  return stance.pose;
}

std::optional<Pose> TrialDrive::part(const Pose& from, const PlanarTwist& twist) {
  const TwistRamp ramp{twist, twist, kTrialPart_ns};
  const Stance stance = ground_.stand(from * displacement(ramp).level());
  if (stance.fault) return std::nullopt;
  if (check_.blocker(make_part(0, from, ramp, stance.pose), kClearance)) return std::nullopt;
  return stance.pose;
}

std::optional<Pose> TrialDrive::go(const Pose& from, const Vec2& to) {
  const int most = 10 + static_cast<int>(4.0 * (to - from.t.head<2>()).norm() / kLongestPart);
  std::optional<Pose> pose = from;
  for (int i = 0; pose && i < most; ++i) {
    const Vec2 left = to - pose->t.head<2>();
    if (left.norm() < kArrived) return pose;
    Eigen::Matrix2d axes;
    axes << (pose->q * Vec3::UnitX()).head<2>(), (pose->q * Vec3::UnitY()).head<2>();
    const Vec2 way = axes.inverse() * left;
    const Vec2 velocity = way * (std::min(1.0, kLongestPart / way.norm()) / kTrialPart_s);
    pose = part(*pose, {velocity.x(), velocity.y(), 0.0});
  }
  return std::nullopt;
}

std::optional<Pose> TrialDrive::turn(const Pose& from, double angle) {
  const int parts = static_cast<int>(std::ceil(std::abs(angle) / kGreatestPartTurn));
  std::optional<Pose> pose = from;
  for (int i = 0; pose && i < parts; ++i) pose = part(*pose, {0.0, 0.0, angle / (parts * kTrialPart_s)});
  return pose;
}

}  // namespace hallway::contact
