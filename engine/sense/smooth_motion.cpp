// SPDX-License-Identifier: MIT
#include "sense/smooth_motion.hpp"

#include <cmath>
#include <numbers>

namespace hallway::sense {

SmoothMotion::SmoothMotion(const Random& random, std::uint32_t step, std::uint64_t index, double speed_m_s) {
  // A wave of speed v sin has a mean square of v^2 / 2, and there are six.
  const double wave_speed = speed_m_s / std::sqrt(0.5 * 3.0 * static_cast<double>(kWavesPerAxis));
  // From its lowest to its highest point a wave passes twice its reach.
  constexpr double kLargest_m = 0.5 * kReach_m / static_cast<double>(kWavesPerAxis);
  std::uint64_t at = index * 2 * 3 * kWavesPerAxis;
  for (auto& axis : waves_) {
    for (Wave& wave : axis) {
      wave.reach_m = random.uniform(step, at++, kLargest_m / 3.0, kLargest_m);
      wave.phase = random.uniform(step, at++, 0.0, 2.0 * std::numbers::pi);
      wave.rate = wave_speed / wave.reach_m;
      wave.start = std::sin(wave.phase);
    }
  }
}

Vec3 SmoothMotion::offset(double t_s) const {
  Vec3 offset = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    for (const Wave& wave : waves_[static_cast<std::size_t>(axis)]) {
      offset[axis] += wave.reach_m * (std::sin(wave.phase + wave.rate * t_s) - wave.start);
    }
  }
  return offset;
}

}  // namespace hallway::sense
