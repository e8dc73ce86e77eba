// SPDX-License-Identifier: MIT
#pragma once

// What stands in the bag of the tests. Read also by its writer, which includes ROS and is C++17.

#include <array>
#include <cstdint>

namespace hallway::test::bag {

constexpr std::uint32_t kMessages = 6;
constexpr std::uint32_t kPoints = 40;
constexpr std::uint32_t kNotFiniteMessage = 2;  ///< whose point kNotFinitePoint of topic /cloud has no x
constexpr std::uint32_t kNotFinitePoint = 3;
constexpr std::uint32_t kBeams = 60;

/// A point of the clouds; 32-bit floats hold it exactly.
constexpr std::array<float, 3> point(std::uint32_t message, std::uint32_t index) {
  const auto i = static_cast<float>(index), m = static_cast<float>(message);
  return {2.0f + 0.25f * i - 0.125f * m, -3.0f + 0.5f * static_cast<float>(index * 7 % 13), 0.0625f * i};
}

/// A range of the scans; beams 5, 15, … hit nothing.
constexpr float range(std::uint32_t message, std::uint32_t beam) {
  return 2.0f + 0.03125f * static_cast<float>(beam * 11 % 17) + 0.0078125f * static_cast<float>(message);
}
constexpr bool hits(std::uint32_t beam) {
  return beam % 10 != 5;
}
constexpr float kAngleMin = -1.5f, kAngleIncrement = 0.05f, kRangeMin = 0.1f, kRangeMax = 20.0f;

/// Stamp of a message of clouds and scans, and of the poses half a period before each of them.
constexpr std::uint32_t kSeconds = 1500000000;
constexpr std::uint32_t nanoseconds(std::uint32_t message) {
  return 100000001u * message + 50000000u;
}
constexpr std::uint32_t pose_nanoseconds(std::uint32_t pose) {
  return 100000001u * pose;
}

}  // namespace hallway::test::bag
