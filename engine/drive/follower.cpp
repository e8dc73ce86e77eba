// SPDX-License-Identifier: MIT
#include "drive/follower.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.hpp"
#include "base/text.hpp"
#include "drive/wheels.hpp"

namespace hallway::drive {
namespace {

constexpr double kArrivalM = 0.01;       // this near to the end, the robot is there
constexpr double kAboveDeadBand = 1.25;  // slowest speed before the end, in dead bands
constexpr double kNoDistance = 1e-9;     // [m]

void check_positive(const char* key, double value) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw Error(ErrorCode::kBadInput, "must be positive and finite, not " + format_double(value),
              {.element = "key `" + std::string(key) + "`"});
}

/// A point of the world's plane in the frame of the body, seen from above.
Vec2 in_body(const Pose& T_world_body, const Vec2& point) {
  const Vec2 forward = (T_world_body.q * Vec3::UnitX()).head<2>().normalized();
  const Vec2 way = point - T_world_body.t.head<2>();
  return {forward.dot(way), forward.x() * way.y() - forward.y() * way.x()};
}

/// The greatest curvature of a car's way [1/m].
double greatest_curvature(const DriveSpec& spec) {
  return std::tan(spec.greatest_steering_rad) / spec.axle_distance_m;
}

}  // namespace

Follower::Follower(const std::vector<Vec3>& points, const DriveSpec& spec, const FollowerSettings& settings)
    : path_(points, settings.closed), spec_(spec), settings_(settings) {
  check(spec_);
  check_positive("look_ahead_m", settings.look_ahead_m);
  check_positive("speed_m_s", settings.speed_m_s);
  check_positive("period_s", settings.period_s);
  check_positive("lost_look_aheads", settings.lost_look_aheads);
}

double Follower::wanted_speed() const {
  const double speed = std::min(settings_.speed_m_s, spec_.max_speed_m_s);
  if (path_.is_closed()) return speed;
  // Half the deceleration, and no farther than to the end until the next command acts. A dead band makes the robot pass the end by up to one such way.
  const double rest = std::max(0.0, remaining_m());
  const double braking = std::sqrt(deceleration_limit(spec_) * rest);
  const double reaction = rest / (settings_.period_s + seconds(spec_.latency_ns));
  return std::min(speed, std::max(std::min(braking, reaction), kAboveDeadBand * spec_.dead_band_m_s));
}

double Follower::driven_speed(double wanted, double curvature) const {
  const double by_turn = spec_.max_angular_rad_s / std::max(std::abs(curvature), kNoDistance);
  double speed = std::min(wanted, by_turn);
  if (spec_.kind == DriveKind::kAckermann) return speed;
  double fastest = 0.0;  // wheel, per speed of the body
  for (const double wheel : wheel_speeds(spec_, {1.0, 0.0, curvature}))
    fastest = std::max(fastest, std::abs(wheel));
  return std::min(speed, spec_.max_speed_m_s / fastest);
}

Command Follower::pursue(const Vec2& aim) const {
  const bool is_car = spec_.kind == DriveKind::kAckermann;
  if (aim.x() <= 0.0 && !is_car) return {0.0, 0.0, std::copysign(spec_.max_angular_rad_s, aim.y())};
  double curvature = 2.0 * aim.y() / std::max(aim.squaredNorm(), kNoDistance);
  if (is_car) {
    const double greatest = greatest_curvature(spec_);
    if (aim.x() <= 0.0) curvature = std::copysign(greatest, aim.y());
    curvature = std::clamp(curvature, -greatest, greatest);
  }
  const double driven = curvature / (1.0 - spec_.turn_slip);
  const double speed = driven_speed(wanted_speed(), driven);
  return {speed, 0.0, speed * driven};
}

FollowStep Follower::next(const Pose& T_world_body) {
  const Nearest place = path_.nearest(T_world_body.t.head<2>(), along_m_, along_m_ + settings_.look_ahead_m);
  along_m_ = place.along_m;
  FollowStep step{.along_m = along_m_, .distance_m = place.distance_m};
  step.lost = place.distance_m > settings_.lost_look_aheads * settings_.look_ahead_m;
  done_ = done_ || (!path_.is_closed() && !step.lost && remaining_m() <= kArrivalM);
  step.done = done_;
  if (!step.lost && !step.done) {
    step.command = pursue(in_body(T_world_body, path_.at(along_m_ + settings_.look_ahead_m)));
  }
  return step;
}

}  // namespace hallway::drive
