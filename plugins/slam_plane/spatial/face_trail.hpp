// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_plane/spatial/evidence.hpp"
#include "slam_plane/spatial/sighting.hpp"

namespace hallway::slam_plane::spatial {

/// Where a face was seen last, which tells whether it moves. Map frame.
class FaceTrail {
 public:
  /// Notes a sighting of the face.
  /// @param plane  of the face as the map has it
  /// @param stray  the sighting lies beside it: one more in a row, if it was
  /// seen just before
  void note(const Sighting& sighting, const Pose3& T_map_robot, const Feature& plane, bool stray,
            std::uint64_t iteration);

  /// Whether sightings in a row lay beside the face, and ever farther away: it
  /// moves.
  bool moves() const;
  /// Whether the face may be where it was seen last, beside its place in the
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
  std::uint32_t strays_ = 0;   // in a row
  Vec4 first_ = Vec4::Zero();  // plane of the first of them
};

}  // namespace hallway::slam_plane::spatial
