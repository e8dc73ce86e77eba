// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/pair_sums.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::slam_plane::thesis {
namespace {

__extension__ using Signed128 = __int128;

constexpr double kQuanta_per_m = 68719476736.0;  // 2^36

/// A vector in whole quanta.
struct Whole {
  std::int64_t x, y;
};

std::int64_t whole(double value) {
  const double scaled = value * kQuanta_per_m;
  return static_cast<std::int64_t>(scaled + std::copysign(0.5, scaled));
}

Whole whole(const Vec2& v) {
  return {whole(v.x()), whole(v.y())};
}

Signed128 dot(const Whole& a, const Whole& b) {
  return static_cast<Signed128>(a.x) * b.x + static_cast<Signed128>(a.y) * b.y;
}

Vec2 metres(const std::array<std::uint64_t, 2>& sum) {
  return Vec2(static_cast<double>(static_cast<std::int64_t>(sum[0])),
              static_cast<double>(static_cast<std::int64_t>(sum[1]))) /
         kQuanta_per_m;
}

Whole signed_sum(const std::array<std::uint64_t, 2>& sum) {
  return {static_cast<std::int64_t>(sum[0]), static_cast<std::int64_t>(sum[1])};
}

/// n * sum of products - product of sums, which is n squared times the covariance [m^2].
double spread(std::int64_t n, Unsigned128 products, const Whole& a, const Whole& b) {
  const Signed128 exact = n * static_cast<Signed128>(products) - dot(a, b);
  return static_cast<double>(exact) / (kQuanta_per_m * kQuanta_per_m);
}

/// Applies an operation to each sum and the same one of the other.
template <typename Operation>
PairSums& combine(PairSums& sums, const PairSums& other, Operation apply) {
  apply(sums.count, other.count);
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t i = 0; i < 2; ++i) apply(sums.offset[c][i], other.offset[c][i]);
    apply(sums.offset_square[c], other.offset_square[c]);
    apply(sums.offset_direction[c], other.offset_direction[c]);
  }
  for (std::size_t i = 0; i < 2; ++i) apply(sums.direction[i], other.direction[i]);
  apply(sums.direction_square, other.direction_square);
  return sums;
}

}  // namespace

PairSums& PairSums::operator+=(const PairSums& other) {
  return combine(*this, other, [](auto& sum, auto term) { sum += term; });
}

PairSums& PairSums::operator-=(const PairSums& other) {
  return combine(*this, other, [](auto& sum, auto term) { sum -= term; });
}

PairSums sums_of(const TimedObservation& a, const TimedObservation& b) {
  const Pose2 T_robot_a{Vec2::Zero(), a.direction};
  const Whole u = whole(T_robot_a.unrotate(b.direction));
  PairSums sums;
  sums.count = 1;
  sums.direction = {static_cast<std::uint64_t>(u.x), static_cast<std::uint64_t>(u.y)};
  sums.direction_square = static_cast<Unsigned128>(dot(u, u));
  for (std::size_t c = 0; c < 4; ++c) {
    const Whole p = whole(T_robot_a.unrotate(b.segment.end[c % 2] - a.segment.end[c / 2]));
    sums.offset[c] = {static_cast<std::uint64_t>(p.x), static_cast<std::uint64_t>(p.y)};
    sums.offset_square[c] = static_cast<Unsigned128>(dot(p, p));
    sums.offset_direction[c] = static_cast<Unsigned128>(dot(p, u));
  }
  return sums;
}

OffsetMoments offset_moments(const PairSums& sums, int combination, const double (&size)[2]) {
  const auto c = static_cast<std::size_t>(combination);
  const double half_a = (c / 2 == 0 ? 0.5 : -0.5) * size[0];  // from the end to the middle
  const double half_b = (c % 2 == 0 ? 0.5 : -0.5) * size[1];
  const std::int64_t n = sums.count;
  const auto count = static_cast<double>(n);
  const Whole p = signed_sum(sums.offset[c]);
  const Whole u = signed_sum(sums.direction);
  OffsetMoments moments;
  moments.mean = (metres(sums.offset[c]) + half_b * metres(sums.direction)) / count - Vec2(half_a, 0.0);
  const double spreads = spread(n, sums.offset_square[c], p, p) +
                         2.0 * half_b * spread(n, sums.offset_direction[c], p, u) +
                         half_b * half_b * spread(n, sums.direction_square, u, u);
  moments.deviation = std::sqrt(std::max(spreads, 0.0)) / count;
  return moments;
}

Vec2 mean_direction(const PairSums& sums) {
  return metres(sums.direction).normalized();
}

}  // namespace hallway::slam_plane::thesis
