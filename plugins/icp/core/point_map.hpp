// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "geometry/hash_grid.hpp"
#include "icp/core/types.hpp"

namespace hallway::icp {

/// One point of the map.
struct Landmark {
  Vec3 position = Vec3::Zero();  ///< mean of its observations, map frame [m]
  std::uint32_t observations = 0;
};

/// "This point was taken for no landmark."
inline constexpr std::uint64_t kNoLandmark = ~std::uint64_t{0};

/// The points of all frames: those nearer than the separation to a landmark are observations of it, others are new ones. A landmark is
/// looked for where it was seen first. Its number is its place in landmarks().
class PointMap {
 public:
  /// @param separation_m  above 0
  explicit PointMap(double separation_m) : separation_m_(separation_m), grid_(separation_m) {}

  /// Takes a point of the map frame in. @return its landmark
  std::uint64_t add(const Vec3& p);

  const std::vector<Landmark>& landmarks() const { return landmarks_; }

  /// The positions of those within `radius_m` of a place, in the order of their numbers. O(landmarks).
  Points near(const Vec3& place, double radius_m) const;

 private:
  /// The landmark that was first seen nearest to `p`, within the separation; of several the one with the smallest number.
  std::optional<std::uint32_t> known_near(const Vec3& p) const;

  double separation_m_;
  HashGrid grid_;                 // of the places where landmarks were first seen
  std::vector<Vec3> first_seen_;  // likewise
  std::vector<Landmark> landmarks_;
};

}  // namespace hallway::icp
