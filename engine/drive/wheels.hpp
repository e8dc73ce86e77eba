// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "drive/motion.hpp"
#include "drive/spec.hpp"

namespace hallway::drive {

/// A number for each wheel: left, right; omnidirectional: front left, front right, rear left, rear right. Ackermann has its rear wheels here. Those that
/// a kind does not have are 0.
using PerWheel = std::array<double, 4>;

/// How many wheels of a kind are driven: 2, or 4 for omnidirectional.
std::size_t wheel_count(DriveKind kind);
/// Their names, e.g. "left", "right".
std::span<const std::string_view> wheel_names(DriveKind kind);

/// Speeds of the wheels' rims that are linear in time [m/s].
struct WheelRamp {
  PerWheel from{};
  PerWheel to{};
  std::int64_t duration_ns = 0;

  bool operator==(const WheelRamp&) const = default;
};

/// The way of each rim over a ramp [m]: exact but for rounding, forward positive.
PerWheel travel(const WheelRamp& ramp);

/// The speed of each rim for a twist of the body, if no wheel slips [m/s]. The body's origin is the middle between the wheels; for ackermann, the middle of
/// the rear axle. Omnidirectional wheels are mecanum wheels with rollers at 45 degrees (Muir and Neuman, 1987).
PerWheel wheel_speeds(const DriveSpec& spec, const PlanarTwist& twist);

/// The twist of the body that the speeds of the rims make, without slip: the inverse of wheel_speeds() for the twists that a drive can do, the least-squares
/// twist for other speeds.
PlanarTwist twist_of(const DriveSpec& spec, const PerWheel& speeds);

}  // namespace hallway::drive
