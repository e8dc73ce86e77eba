// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include "icp/core/types.hpp"

namespace hallway::icp {

/// Points in cubes that overlap, so that whatever lies within `reach_m` of a place stands in the one cube that holds the place (thesis 3.2.2,
/// step 3). Adding and asking cost O(points in a cube). A point stands in up to eight cubes.
class OverlappingGrid {
 public:
  /// @param reach_m  above 0: the largest distance that nearest() is asked for
  explicit OverlappingGrid(double reach_m) : reach_m_(reach_m), edge_m_(2.0 * reach_m) {}

  /// Adds the point with the next number, counted from 0.
  void add(const Vec3& p);

  /// The nearest point within reach_m (inclusive) of `place`; of several, the one with the smallest number.
  std::optional<std::uint32_t> nearest(const Vec3& place) const;

 private:
  using Cube = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cube& cube) const;
  };
  Cube cube_of(const Vec3& p) const;

  double reach_m_;
  double edge_m_;
  Points points_;
  std::unordered_map<Cube, std::vector<std::uint32_t>, Hash> cubes_;
};

}  // namespace hallway::icp
