// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "drive/drive.hpp"

namespace hallway::drive::testing {

inline constexpr std::array<DriveKind, 4> kKinds{DriveKind::kDifferential, DriveKind::kTracked,
                                                 DriveKind::kAckermann, DriveKind::kOmnidirectional};
inline constexpr std::int64_t kSecond = 1'000'000'000;

/// Random numbers that are the same with every standard library.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double within(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1.0p-53);
  }
  std::int64_t whole(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }

 private:
  std::mt19937_64 engine_;
};

/// A valid spec of any kind with random limits, without noise.
inline DriveSpec random_spec(Dice& dice) {
  DriveSpec spec{.kind = kKinds[static_cast<std::size_t>(dice.whole(0, 3))]};
  spec.wheel_base_m = dice.within(0.1, 2.0);
  spec.axle_distance_m = dice.within(0.1, 3.0);
  spec.greatest_steering_rad = dice.within(0.1, 1.2);
  spec.max_steering_rate_rad_s = dice.within(0.2, 5.0);
  spec.max_speed_m_s = dice.within(0.1, 3.0);
  if (spec.kind == DriveKind::kOmnidirectional) spec.max_lateral_m_s = dice.within(0.05, spec.max_speed_m_s);
  spec.max_angular_rad_s = dice.within(0.1, 5.0);
  spec.max_acceleration_m_s2 = dice.within(0.2, 5.0);
  if (dice.whole(0, 1) == 1) spec.max_deceleration_m_s2 = dice.within(0.2, 5.0);
  spec.max_angular_acceleration_rad_s2 = dice.within(0.2, 9.0);
  spec.latency_ns = dice.whole(0, 300'000'000);
  if (spec.kind == DriveKind::kTracked) spec.turn_slip = dice.within(0.0, 0.9);
  return spec;
}

/// Adds noise and slip of all sorts.
inline void add_noise(DriveSpec& spec) {
  if (spec.kind == DriveKind::kTracked) spec.turn_slip_noise = 0.1;
  spec.forward_noise = {0.02, 0.05, 200'000'000};
  spec.angular_noise = {-0.01, 0.04, 0};
  spec.lateral_drift = {0.01, 0.03, 1'000'000'000};
  spec.left_slip = {0.03, 0.02, 300'000'000};
  spec.right_slip = {0.01, 0.02, 500'000'000};
}

/// A command somewhat beyond any limit of a random spec.
inline Command random_command(Dice& dice) {
  return {dice.within(-4.0, 4.0), dice.within(-4.0, 4.0), dice.within(-6.0, 6.0)};
}

/// Goes on to a time, and moves a pose by the pieces.
inline void drive_on(Drive& drive, std::int64_t to_ns, PlanarPose& pose) {
  for (const Motion& motion : drive.advance(to_ns)) pose = move(pose, motion.body);
}

}  // namespace hallway::drive::testing
