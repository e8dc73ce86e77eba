// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "slam_plane/thesis/observation.hpp"

namespace hallway::slam_plane::thesis {

__extension__ using Unsigned128 = unsigned __int128;  // not ISO C++, but on both compilers

/// What is summed up of two planes seen in the same iterations, to know mean and standard deviation of the offset between their estimated middles for all four combinations
/// of ends and for any sizes (Rules 3, 13).
///
/// Per iteration both planes are turned so that a lies along x. With b's direction u and p the offset from an end of a to an end of b, the middles' offset is p ± u size_b/2 ∓ x size_a/2. So sums of p, u, p², pu and u²
/// suffice. They are whole numbers of 2^-36 m, modulo 2^64 and 2^128: exact in any order, and what was added can be taken away, which is
/// why sums that were kept are equal to sums made anew. Offsets are below 2^11 m and observations at most 2^14, so nothing that is asked for overflows.
struct PairSums {
  std::int64_t count = 0;
  std::array<std::array<std::uint64_t, 2>, 4> offset{};  ///< p, by 2 * end of a + end of b
  std::array<std::uint64_t, 2> direction{};              ///< u
  std::array<Unsigned128, 4> offset_square{};            ///< p²
  std::array<Unsigned128, 4> offset_direction{};         ///< p·u
  Unsigned128 direction_square = 0;                      ///< u²

  PairSums& operator+=(const PairSums& other);
  PairSums& operator-=(const PairSums& other);
  bool operator==(const PairSums&) const = default;
};

/// What one iteration adds. O(1).
PairSums sums_of(const TimedObservation& a, const TimedObservation& b);

/// Mean and standard deviation of the offset from a's estimated middle to b's, for one combination of ends.
struct OffsetMoments {
  Vec2 mean = Vec2::Zero();  ///< a's frame [m]
  double deviation = 0.0;    ///< root of the trace of the covariance [m]
};

/// @param combination  2 * end of a + end of b
/// @param size         of a and b [m]
/// The sums must not be empty.
OffsetMoments offset_moments(const PairSums& sums, int combination, const double (&size)[2]);

/// Mean direction of b in a's frame, unit.
Vec2 mean_direction(const PairSums& sums);

}  // namespace hallway::slam_plane::thesis
