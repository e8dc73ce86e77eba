// SPDX-License-Identifier: MIT
#include "drive/limits.hpp"

#include <algorithm>
#include <cmath>

#include "drive/wheels.hpp"

namespace hallway::drive {
namespace {

constexpr double kRounding = 1e-12;  // relative, of a wheel's speed at its limit

double fastest_wheel(const DriveSpec& spec, const PlanarTwist& twist) {
  double fastest = 0.0;
  for (const double speed : wheel_speeds(spec, twist)) fastest = std::max(fastest, std::abs(speed));
  return fastest;
}

void apply_dead_band(double& part, double band, bool& too_small) {
  if (part == 0.0 || std::abs(part) >= band) return;
  part = 0.0;
  too_small = true;
}

void clamp_part(double& part, double limit, bool& too_great) {
  if (std::abs(part) <= limit) return;
  part = std::copysign(limit, part);
  too_great = true;
}

void leave_out(double& part, bool& left_out) {
  left_out = left_out || part != 0.0;
  part = 0.0;
}

void scale_to_wheels(const DriveSpec& spec, LimitedCommand& limited) {
  Command& command = limited.command;
  if (wheels_are_within(spec, command)) return;
  const double share = spec.max_speed_m_s / fastest_wheel(spec, command);
  limited.clamps.speed = limited.clamps.speed || command.forward_m_s != 0.0;
  limited.clamps.lateral = limited.clamps.lateral || command.lateral_m_s != 0.0;
  limited.clamps.angular = limited.clamps.angular || command.angular_rad_s != 0.0;
  command = {share * command.forward_m_s, share * command.lateral_m_s, share * command.angular_rad_s};
}

void steer(const DriveSpec& spec, LimitedCommand& limited) {
  Command& command = limited.command;
  if (command.forward_m_s == 0.0) {
    leave_out(command.angular_rad_s, limited.clamps.left_out);
    return;
  }
  // atan2 and not a quotient, which could overflow; backwards, the wheels turn to the other side.
  const double side = command.angular_rad_s * spec.axle_distance_m * std::copysign(1.0, command.forward_m_s);
  double angle = std::atan2(side, std::abs(command.forward_m_s));
  bool too_great = false;
  clamp_part(angle, spec.greatest_steering_rad, too_great);
  limited.steering_rad = angle;
  if (!too_great) return;
  limited.clamps.steering = true;
  command.angular_rad_s = command.forward_m_s * std::tan(angle) / spec.axle_distance_m;
}

}  // namespace

bool wheels_are_within(const DriveSpec& spec, const PlanarTwist& twist) {
  return spec.kind == DriveKind::kAckermann ||
         fastest_wheel(spec, twist) <= spec.max_speed_m_s * (1.0 + kRounding);
}

LimitedCommand limit(const DriveSpec& spec, const Command& command) {
  LimitedCommand limited{.command = command};
  Command& obeyed = limited.command;
  Clamps& clamps = limited.clamps;
  apply_dead_band(obeyed.forward_m_s, spec.dead_band_m_s, clamps.dead_band);
  apply_dead_band(obeyed.angular_rad_s, spec.dead_band_rad_s, clamps.dead_band);
  clamp_part(obeyed.forward_m_s, spec.max_speed_m_s, clamps.speed);
  clamp_part(obeyed.angular_rad_s, spec.max_angular_rad_s, clamps.angular);
  if (spec.kind == DriveKind::kOmnidirectional) {
    apply_dead_band(obeyed.lateral_m_s, spec.dead_band_m_s, clamps.dead_band);
    clamp_part(obeyed.lateral_m_s, lateral_limit(spec), clamps.lateral);
  } else {
    leave_out(obeyed.lateral_m_s, clamps.left_out);
  }
  if (spec.kind == DriveKind::kAckermann) {
    steer(spec, limited);
  } else {
    scale_to_wheels(spec, limited);
  }
  return limited;
}

}  // namespace hallway::drive
