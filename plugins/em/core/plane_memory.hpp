// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "em/core/types.hpp"

namespace hallway::em {

/// The planes of the last frame of one sensor, and which ids have been given.
class PlaneMemory {
 public:
  /// The planes of the last frame, without their members; none at first.
  const std::vector<Plane>& planes() const { return planes_; }
  /// How many points that frame had, and how many of them each of planes() had.
  std::size_t points() const { return points_; }
  const std::vector<std::size_t>& members() const { return members_; }

  /// Gives each plane found the id of the plane of the last frame that it is, or one that none has had; then these are the planes of the last
  /// frame. Two planes are the same if their normals, centroids and distances differ by no more than a sensor's small motion makes: a
  /// fraction of their size. Of several the most alike are.
  void identify(Extraction& found);

 private:
  std::vector<Plane> planes_;
  std::vector<std::size_t> members_;
  std::size_t points_ = 0;
  std::uint64_t next_id_ = 0;
};

}  // namespace hallway::em
