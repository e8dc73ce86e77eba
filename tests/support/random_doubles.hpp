// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/random.hpp"

namespace hallway::test {

/// Finite doubles of every magnitude: random bit patterns, denormals among them, and the extremes, both zeros included.
inline std::vector<double> random_doubles(std::size_t count, std::uint64_t seed) {
  using Limits = std::numeric_limits<double>;
  std::vector<double> values = {0.0,
                                -0.0,
                                Limits::denorm_min(),
                                -Limits::denorm_min(),
                                Limits::min(),
                                Limits::max(),
                                Limits::lowest(),
                                Limits::epsilon(),
                                0.1,
                                1e23,
                                5e-324,
                                9007199254740993.0};
  const Random random(seed, stream_id("test.random_doubles"));
  constexpr std::uint64_t kMantissa = (std::uint64_t{1} << 52) - 1;
  for (std::uint64_t index = 0; values.size() < count; ++index) {
    const auto word = random.bits(0, index);
    std::uint64_t bits = (std::uint64_t{word[0]} << 32) | word[1];
    if (word[2] % 8 == 0) bits &= kMantissa;  // a denormal
    const double value = std::bit_cast<double>(bits);
    if (std::isfinite(value)) values.push_back(value);
  }
  return values;
}

/// Whether two doubles have the same bits; unlike ==, it tells the zeros apart.
inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace hallway::test
