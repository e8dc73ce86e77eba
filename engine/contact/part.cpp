// SPDX-License-Identifier: MIT
#include "contact/part.hpp"

#include <algorithm>

namespace hallway::contact {
namespace {

double seconds_of(const TwistRamp& ramp) {
  return 1e-9 * static_cast<double>(ramp.duration_ns);
}

double greatest_turn(const TwistRamp& ramp) {
  return std::max(std::abs(ramp.from.angular_rad_s), std::abs(ramp.to.angular_rad_s)) * seconds_of(ramp);
}

}  // namespace

Part make_part(std::int64_t begin_ns, const Pose& from, const TwistRamp& ramp, const Pose& to) {
  Part part{begin_ns, ramp, from, to, Vec3::Zero(), Vec3::Zero()};
  const Pose planar = from * displacement(ramp).level();
  part.shift = to.t - planar.t;
  if (!(to.q.coeffs() == planar.q.coeffs())) part.turn = rotation_vector(to.q * planar.q.conjugate());
  return part;
}

Part make_drop(std::int64_t begin_ns, const Pose& from, const Pose& to) {
  return make_part(begin_ns, from, TwistRamp{}, to);
}

Pose pose_in(const Part& part, double share) {
  if (share <= 0.0) return part.from;
  if (share >= 1.0) return part.to;
  Pose pose = part.from * displacement(part.ramp, share).level();
  pose.t += share * part.shift;
  if (!part.turn.isZero(0.0)) pose.q = (rotation_by(share * part.turn) * pose.q).normalized();
  return pose;
}

PartMotion motion_in(const Part& part, double after_s) {
  const double seconds = seconds_of(part.ramp);
  if (seconds == 0.0) return {.pose = part.to};
  const double share = std::clamp(after_s / seconds, 0.0, 1.0);
  const PlanarTwist twist = part.ramp.at(share);
  const PlanarTwist change = (part.ramp.to - part.ramp.from) * (1.0 / seconds);
  PartMotion now{.pose = pose_in(part, share)};
  const Quat planar = (part.from * displacement(part.ramp, share).level()).q;
  const double w = twist.angular_rad_s;
  now.velocity = planar * Vec3(twist.forward_m_s, twist.lateral_m_s, 0.0) + part.shift / seconds;
  now.acceleration = planar * Vec3(change.forward_m_s - w * twist.lateral_m_s,
                                   change.lateral_m_s + w * twist.forward_m_s, 0.0);
  const Quat tilted = rotation_by(share * part.turn);
  const Vec3 axis = tilted * (part.from.q * Vec3::UnitZ()), tilting = part.turn / seconds;
  now.angular_velocity = tilting + w * axis;
  now.angular_acceleration = w * tilting.cross(axis) + change.angular_rad_s * axis;
  return now;
}

double bend(const Part& part, double radius) {
  const double seconds = seconds_of(part.ramp);
  const PlanarTwist change = part.ramp.to - part.ramp.from;
  const double way = std::max(part.ramp.from.speed(), part.ramp.to.speed()) * seconds;
  const double turn = greatest_turn(part.ramp), tilt = part.turn.norm();
  const double of_origin = way * turn + change.speed() * seconds;
  const double of_arm =
      (turn + tilt) * (turn + tilt) + turn * tilt + std::abs(change.angular_rad_s) * seconds;
  return (of_origin + radius * of_arm) / 8.0;
}

double turning(const Part& part) {
  return greatest_turn(part.ramp) + part.turn.norm();
}

}  // namespace hallway::contact
