// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "em/core/points.hpp"
#include "em/core/principal_frame.hpp"
#include "em/core/raw_vector.hpp"
#include "em/core/types.hpp"
#include "em/core/workers.hpp"

namespace hallway::em {

/// The cloud as every later stage sees it: without points that are not finite, each place once, in an order
/// that depends on the coordinates alone, in a frame that turns with the cloud. So no result depends on the
/// order given, and doubling every point changes nothing.
struct CanonicalCloud {
  Points points;                   ///< in `frame`, in Morton order
  CloudFrame frame;                ///< turns and moves with the cloud
  RawVector<PointIndex> given;     ///< indices of the points given, grouped by place in `points`
  RawVector<std::uint32_t> first;  ///< place i was given by given[first[i]] .. given[first[i + 1]]

  /// The points given that stand at place `i`.
  std::span<const PointIndex> given_at(std::size_t i) const {
    return std::span<const PointIndex>(given).subspan(first[i], first[i + 1] - first[i]);
  }
};

/// Largest coordinate that counts as finite; squares of it must be finite too.
inline constexpr double kLargestCoordinate = 1e100;

/// Orders a cloud; O(n) but for points that share a Morton cell, which are compared.
/// Throws std::length_error from 2^28 points.
CanonicalCloud canonical_order(std::span<const Vec3> cloud, Workers& workers);

}  // namespace hallway::em
