// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace hallway {

/// Counter-based random numbers: every number is a pure function of (seed, stream, step, index), so that neither the
/// order of calls nor the number of threads can change it. Philox 4x32-10 (Salmon et al., "Parallel Random Numbers: As
/// Easy as 1, 2, 3", SC 2011). Normal deviates are computed with operations of IEEE 754 only, no libm function whose
/// last bit depends on the machine.
class Random {
 public:
  /// @param seed    the run's seed
  /// @param stream  what the numbers are for; make it with stream_id("sensor.noise")
  constexpr Random(std::uint64_t seed, std::uint32_t stream) : seed_(seed), stream_(stream) {}

  /// 128 random bits. `step` is usually the iteration (below 2^32), `index` the number within it.
  std::array<std::uint32_t, 4> bits(std::uint32_t step, std::uint64_t index) const;
  /// Uniform in [0, 1), 53 bits.
  double uniform(std::uint32_t step, std::uint64_t index) const;
  /// Uniform in [low, high).
  double uniform(std::uint32_t step, std::uint64_t index, double low, double high) const;
  /// Standard normal deviate, by inversion; |x| < 8.3.
  double normal(std::uint32_t step, std::uint64_t index) const;

 private:
  std::uint64_t seed_;
  std::uint32_t stream_;
};

/// A stable number for a stream's name (FNV-1a).
constexpr std::uint32_t stream_id(std::string_view name) {
  std::uint32_t hash = 2166136261u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

/// Inverse of the standard normal distribution function for 0 < p < 1, relative error about 1e-15
/// (Wichura, algorithm AS 241, PPND16).
double inverse_normal_cdf(double p);

}  // namespace hallway
