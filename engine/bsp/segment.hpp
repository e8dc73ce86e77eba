// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "bsp/tree.hpp"

namespace hallway::bsp {

/// Where a segment enters solid.
struct SegmentHit {
  double fraction = 0.0;      ///< of the way from its start to its end, in [0, 1]
  Vec3 point = Vec3::Zero();  ///< metres
  Vec3 normal =
      Vec3::Zero();        ///< of the face that it meets, towards the empty side; zero if it starts in solid
  std::uint32_t leaf = 0;  ///< the solid leaf
  bool starts_in_solid = false;  ///< `fraction` is then 0
};

/// The first point of a segment that lies in solid, or none.
///
/// Solid is taken without its surface: a segment that ends on a face, starts on it and leaves, or runs along it is not hit, and
/// neither is a point on a face; one that starts on a face and goes in is hit at fraction 0. A segment without length is a point.
/// The leaves that a segment crosses cover it without gaps, so none slips between two solid leaves; rounding may decide either
/// way only where it passes within about 1e-15 of its coordinates' size from the rim of a solid.
///
/// Throws Error{kBadInput} for points that are not finite or beyond kMaxQueryCoordinate. O(depth + leaves crossed); any number of
/// threads may ask at once.
std::optional<SegmentHit> first_solid(const Tree& tree, const Vec3& from, const Vec3& to);

/// Whether first_solid() finds anything, a little faster.
bool blocked(const Tree& tree, const Vec3& from, const Vec3& to);

}  // namespace hallway::bsp
