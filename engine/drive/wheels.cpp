// SPDX-License-Identifier: MIT
#include "drive/wheels.hpp"

namespace hallway::drive {
namespace {

constexpr std::array<std::string_view, 2> kTwoWheels{"left", "right"};
constexpr std::array<std::string_view, 4> kFourWheels{"front_left", "front_right", "rear_left", "rear_right"};

/// The speed of a mecanum wheel per rate of turn [m].
double mecanum_arm(const DriveSpec& spec) {
  return 0.5 * (spec.wheel_base_m + spec.axle_distance_m);
}

}  // namespace

std::size_t wheel_count(DriveKind kind) {
  return wheel_names(kind).size();
}

std::span<const std::string_view> wheel_names(DriveKind kind) {
  if (kind == DriveKind::kOmnidirectional) return kFourWheels;
  return kTwoWheels;
}

PerWheel travel(const WheelRamp& ramp) {
  PerWheel way{};
  for (std::size_t i = 0; i < way.size(); ++i) {
    way[i] = 0.5 * seconds(ramp.duration_ns) * (ramp.from[i] + ramp.to[i]);
  }
  return way;
}

PerWheel wheel_speeds(const DriveSpec& spec, const PlanarTwist& twist) {
  const double forward = twist.forward_m_s;
  if (spec.kind != DriveKind::kOmnidirectional) {
    const double turn = 0.5 * spec.wheel_base_m * twist.angular_rad_s;
    return {forward - turn, forward + turn, 0.0, 0.0};
  }
  const double lateral = twist.lateral_m_s;
  const double turn = mecanum_arm(spec) * twist.angular_rad_s;
  return {forward - lateral - turn, forward + lateral + turn, forward + lateral - turn,
          forward - lateral + turn};
}

PlanarTwist twist_of(const DriveSpec& spec, const PerWheel& speeds) {
  if (spec.kind != DriveKind::kOmnidirectional) {
    return {0.5 * (speeds[0] + speeds[1]), 0.0, (speeds[1] - speeds[0]) / spec.wheel_base_m};
  }
  const auto [front_left, front_right, rear_left, rear_right] = speeds;
  const double arm = mecanum_arm(spec);
  return {0.25 * (front_left + front_right + rear_left + rear_right),
          0.25 * (front_right + rear_left - front_left - rear_right),
          0.25 * (front_right + rear_right - front_left - rear_left) / arm};
}

}  // namespace hallway::drive
