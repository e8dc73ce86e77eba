// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_plane/spatial/evidence.hpp"
#include "slam_plane/spatial/observation.hpp"

namespace hallway::slam_plane::spatial {

/// Where a plane was seen last, which tells whether it moves. Map frame.
class PlaneTrail {
 public:
  /// Notes an observation of the plane.
  /// @param plane  of the plane as the map has it
  /// @param outlier  the observation lies beside it: one more in a row, if it was
  /// seen just before
  void note(const AssociatedObservation& observation, const Pose& T_map_robot, const Feature& plane,
            bool outlier, std::uint64_t iteration);

  /// Whether observations in a row lay beside the plane, and ever farther away: it
  /// moves.
  bool moves() const;
  /// Whether the plane may be where it was seen last, beside its place in the
  /// map.
  bool is_followed(std::uint64_t iteration) const;

  const Feature& plane() const { return plane_; }
  const std::vector<Vec3>& outline() const { return outline_; }

 private:
  Feature plane_;
  Vec3 centre_ = Vec3::Zero();
  std::vector<Vec3> outline_;
  std::uint64_t seen_ = 0;
  bool off_ = false;
  std::uint32_t outliers_ = 0;  // in a row
  Vec4 first_ = Vec4::Zero();   // plane of the first of them
};

}  // namespace hallway::slam_plane::spatial
