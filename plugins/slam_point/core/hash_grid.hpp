// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "slam_point/core/types.hpp"

namespace hallway::slam_point {

/// Points in cubes of one size, found by hashing the cube: insertion, moving and looking near a place cost O(1), whatever
/// the number of points (the incremental overlapping quadtree of thesis 6.5.1).
///
/// Points are named by consecutive numbers from 0. Memory: 20 bytes a point and a table of at least as many cells.
class HashGrid {
 public:
  /// `reach_m` > 0: the largest distance that visit_near() is asked for [m].
  explicit HashGrid(double reach_m);

  /// Adds the point with the next number. Coordinates are finite.
  void add(const Vec3& p);

  /// Tells that point `i` is now at `p`.
  void move(std::uint32_t i, const Vec3& p);

  /// Takes point `i` out for good; its number is not used again.
  void remove(std::uint32_t i) { unlink(i); }

  /// Calls visit(i) once for each point in the (at most eight) cubes that a ball of reach_m about p touches: a superset of the points
  /// within reach_m. The order depends on the history of the grid, so what the caller makes of it must not.
  template <typename Visit>
  void visit_near(const Vec3& p, Visit&& visit) const {
    if (heads_.empty()) return;
    const Cell low = cell_of(p - Vec3::Constant(0.5 * size_));
    for (int corner = 0; corner < 8; ++corner) {
      const Cell cell{low[0] + (corner & 1), low[1] + ((corner >> 1) & 1), low[2] + ((corner >> 2) & 1)};
      for (std::uint32_t i = heads_[bucket_of(cell)]; i != kEnd; i = next_[i]) {
        if (cells_[i] == cell) visit(i);
      }
    }
  }

  void clear();

 private:
  using Cell = std::array<std::int32_t, 3>;
  static constexpr std::uint32_t kEnd = 0xffffffffu;
  static constexpr std::uint32_t kGone = 0xfffffffeu;

  Cell cell_of(const Vec3& p) const;
  std::size_t bucket_of(const Cell& cell) const;
  void link(std::uint32_t i);
  void unlink(std::uint32_t i);
  void grow();

  double size_;  // twice the reach, so that a ball touches two cubes along each axis
  double inverse_size_;
  std::vector<std::uint32_t> heads_;
  std::vector<std::uint32_t> next_;  // kGone for a point that was removed
  std::vector<Cell> cells_;
};

}  // namespace hallway::slam_point
