// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/mapped_planes.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hallway::host {

/// The planes of a plugin's map, checked, in memory that is used again.
class PlaneLandmarkList {
 public:
  void clear();
  /// Copies a list behind those that are there and checks the copy: what mapped_planes.h demands, but for distinct ids.
  /// Throws Malformed. O(planes + corners).
  /// @param planes  as large as version 1.3 has it, or larger
  void add(const hw_mapped_planes_t& planes);

  /// In the order put; first_corner counts in corners().
  std::span<const hw_mapped_plane_t> planes() const { return planes_; }
  /// Of all planes.
  std::span<const hw_mapped_corner_t> corners() const { return corners_; }
  /// The outline of one of the planes.
  std::span<const hw_mapped_corner_t> outline(const hw_mapped_plane_t& plane) const {
    return std::span(corners_).subspan(plane.first_corner, plane.n_corners);
  }

 private:
  std::vector<hw_mapped_plane_t> planes_;
  std::vector<hw_mapped_corner_t> corners_;
};

}  // namespace hallway::host
