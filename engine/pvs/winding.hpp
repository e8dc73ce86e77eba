// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "geom/polygon.hpp"

namespace hallway::pvs {

/// A convex polygon of at most kCapacity vertices, without heap.
struct Winding {
  static constexpr std::size_t kCapacity = 24;
  std::size_t count = 0;
  std::array<Vec3, kCapacity> points{};  ///< metres; those from `count` on mean nothing
};

/// A plane of which only the half-space in front counts; `slack` is how far the computed distance of a point
/// of the world may be from the true one.
struct Cutter {
  Vec3 normal = Vec3::Zero();
  double offset = 0.0;
  double slack = 0.0;

  /// Distance of a point from the plane, at least the true one: what is below zero is certainly behind.
  double reach(const Vec3& point) const { return normal.dot(point) - offset + slack; }
};

/// What is left of a winding after a cut.
enum class Cut { kNothing, kPart, kAll };

/// Keeps what a plane has in front of it or on it, and a little more. With kPart the rest is in `rest`, else
/// `rest` is untouched; a cut that would need more than kCapacity vertices is not made (kAll).
Cut cut(const Winding& winding, const Cutter& plane, Winding& rest);

}  // namespace hallway::pvs
