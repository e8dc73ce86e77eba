// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

namespace hallway::sense {

/// Value k >= 1 of a Markov process by dyadic subdivision (Lévy's construction): the value at 1, from each power of two the value at the next, and then middles of
/// intervals whose ends are known, until k is one. Each place of the grid has its own deviate, so any order of calls gives the same numbers. O(log k).
///
/// @param deviate    (place) -> standard normal; the upper end of the last octave is place 0, which no other is
/// @param first      (z) -> value at 1
/// @param next       (value at p, p, z) -> value at 2 p
/// @param middle     (value at low, value at high, half, z) -> value at low + half, where high is low + 2 half
template <typename Deviate, typename First, typename Next, typename Middle>
double dyadic_value(std::uint64_t k, const Deviate& deviate, const First& first, const Next& next,
                    const Middle& middle) {
  const std::uint64_t power = std::bit_floor(k);
  double at_low = first(deviate(std::uint64_t{1}));
  for (std::uint64_t p = 1; p < power; p *= 2) at_low = next(at_low, p, deviate(2 * p));
  if (k == power) return at_low;
  double at_high = next(at_low, power, deviate(2 * power));
  std::uint64_t low = power;
  for (std::uint64_t half = power / 2; half > 0; half /= 2) {
    const std::uint64_t between = low + half;
    const double at_middle = middle(at_low, at_high, half, deviate(between));
    if (k == between) return at_middle;
    if (k < between) {
      at_high = at_middle;
    } else {
      low = between;
      at_low = at_middle;
    }
  }
  return at_low;
}

}  // namespace hallway::sense
