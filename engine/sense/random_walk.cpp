// SPDX-License-Identifier: MIT
#include "sense/random_walk.hpp"

#include <bit>
#include <cmath>

namespace hallway::sense {

RandomWalk::RandomWalk(const Random& random, std::uint32_t step, double sigma, double interval_s)
    : random_(random), step_(step), scale_(sigma * std::sqrt(interval_s)) {}

double RandomWalk::value(std::uint64_t k) const {
  if (k == 0 || scale_ == 0.0) return 0.0;
  // In units of the standard deviation of one increment.
  const std::uint64_t power = std::bit_floor(k);
  double at_low = random_.normal(step_, 1);
  for (std::uint64_t p = 1; p < power; p *= 2)
    at_low += std::sqrt(static_cast<double>(p)) * random_.normal(step_, 2 * p);
  if (k == power) return scale_ * at_low;

  // The upper end of the last octave is 2^64: its key is 0, which no other place has.
  double at_high = at_low + std::sqrt(static_cast<double>(power)) * random_.normal(step_, 2 * power);
  std::uint64_t low = power;
  for (std::uint64_t half = power / 2; half > 0; half /= 2) {
    const std::uint64_t middle = low + half;
    const double at_middle =
        0.5 * (at_low + at_high) + std::sqrt(0.5 * static_cast<double>(half)) * random_.normal(step_, middle);
    if (k == middle) return scale_ * at_middle;
    if (k < middle) {
      at_high = at_middle;
    } else {
      low = middle;
      at_low = at_middle;
    }
  }
  return scale_ * at_low;
}

}  // namespace hallway::sense
