// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/planes.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hallway::host {

/// The planes that a plugin put for one sample, checked; as long as the Outputs they come from are valid.
struct PlaneList {
  std::span<const hw_plane_t> planes;
  std::span<const hw_point3_t> hull_points;
  std::span<const std::uint32_t> members;

  /// The hull of one of the planes; empty where it is not told.
  std::span<const hw_point3_t> hull_of(const hw_plane_t& plane) const {
    return hull_points.subspan(plane.first_hull, plane.n_hull);
  }
  /// The elements of the sample that belong to one of the planes, ascending; empty where they are not told.
  std::span<const std::uint32_t> members_of(const hw_plane_t& plane) const {
    return members.subspan(plane.first_member, plane.n_members);
  }
};

/// Where an empty range begins says nothing, and may be anywhere: has those of each plane begin at 0.
void clear_empty_ranges(std::span<hw_plane_t> planes);

/// Checks what planes.h demands of a list without such ranges. Throws Malformed. O(n log n).
/// @param elements  number of elements of the sample that they were found in
void check_plane_list(const PlaneList& list, std::uint64_t elements);

/// Lists of planes by sample, in memory that is used again.
class PlaneLists {
 public:
  void clear();
  /// Those of a sample; nothing if there are none.
  std::optional<PlaneList> of(std::uint32_t sample) const;
  /// Copies a list and checks the copy: what planes.h demands. Throws Malformed.
  /// @param planes    as large as version 1.1 has it, or larger
  /// @param sample    the index under which of() shall know it
  /// @param elements  number of elements of that sample
  void add(const hw_planes_t& planes, std::uint32_t sample, std::uint64_t elements);

 private:
  struct Range {
    std::size_t first, count;
  };
  struct Entry {
    std::uint32_t sample;
    Range planes, hull_points, members;
  };

  std::vector<Entry> entries_;  ///< by sample
  std::vector<hw_plane_t> planes_;
  std::vector<hw_point3_t> hull_points_;
  std::vector<std::uint32_t> members_;
};

}  // namespace hallway::host
