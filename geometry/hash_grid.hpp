// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway {

/// Points in cubes of one size, found by hashing the cube: insertion, moving and looking near a place cost O(1), whatever
/// the number of points (the incremental overlapping quadtree of thesis 6.5.1).
///
/// Points are named by consecutive numbers from 0. Memory: 40 bytes a point and 16 to 32 of its table.
class HashGrid {
 public:
  /// `reach_m` > 0: the largest distance that visit_near() is asked for [m].
  explicit HashGrid(double reach_m);

  /// Adds the point with the next number. Coordinates are finite.
  void add(const Vec3& p);

  /// Tells that point `i` is now at `p`. Small moves are not taken down: visit_near() looks so much farther.
  void move(std::uint32_t i, const Vec3& p) {
    if ((p - entries_[i].place).squaredNorm() > untold2_) relocate(i, p);
  }

  /// Takes point `i` out for good; its number is not used again.
  void remove(std::uint32_t i) { unlink(i); }

  /// Calls visit(i) once for each point within reach_m of p and some that are a little farther. The order depends on the history of the grid, so what the
  /// caller makes of it must not. Looks into the cubes, at most eight and mostly one to four, that a box of little more than reach_m each way touches.
  template <typename Visit>
  void visit_near(const Vec3& p, Visit&& visit) const {
    if (heads_.empty()) return;
    const Cell low = cell_of(p - Vec3::Constant(half_box_));
    const Cell high = cell_of(p + Vec3::Constant(half_box_));
    for (std::int32_t x = low[0]; x <= high[0]; ++x) {
      for (std::int32_t y = low[1]; y <= high[1]; ++y) {
        for (std::int32_t z = low[2]; z <= high[2]; ++z) visit_cell({x, y, z}, p, visit);
      }
    }
  }

  void clear();

 private:
  using Cell = std::array<std::int32_t, 3>;
  static constexpr std::uint32_t kEnd = 0xffffffffu;
  static constexpr std::uint32_t kGone = 0xfffffffeu;

  struct Entry {
    Vec3 place;
    Cell cell;
    std::uint32_t next;  // in the same bucket; kGone for a point that was removed
  };

  /// Most of a cube is farther off than the reach: what is not is told from the place that stands here, without a look at the caller's data.
  template <typename Visit>
  void visit_cell(const Cell& cell, const Vec3& p, Visit&& visit) const {
    for (std::uint32_t i = heads_[bucket_of(cell)]; i != kEnd; i = entries_[i].next) {
      const Entry& entry = entries_[i];
      if ((entry.place - p).squaredNorm() <= reach2_ && is_same(entry.cell, cell)) visit(i);
    }
  }

  /// Compared here, where `==` of arrays makes a call.
  static bool is_same(const Cell& a, const Cell& b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

  /// The cube that holds p; far cubes share the last one instead of overflowing.
  [[gnu::always_inline]] Cell cell_of(const Vec3& p) const {
    return {cell_along(p.x()), cell_along(p.y()), cell_along(p.z())};
  }
  [[gnu::always_inline]] std::int32_t cell_along(double coordinate) const {
    constexpr double kMaxCell = 1e9;
    const double scaled = std::clamp(coordinate * inverse_size_, -kMaxCell, kMaxCell);
    const auto truncated = static_cast<std::int32_t>(scaled);
    return truncated - (scaled < static_cast<double>(truncated) ? 1 : 0);
  }
  [[gnu::always_inline]] std::size_t bucket_of(const Cell& cell) const {
    // Sums of products with odd numbers without pattern: neighbouring cubes differ in all upper bits.
    const auto part = [&](std::size_t axis, std::uint64_t factor) {
      return static_cast<std::uint64_t>(static_cast<std::uint32_t>(cell[axis])) * factor;
    };
    const std::uint64_t h =
        part(0, 0x9e3779b97f4a7c15u) + part(1, 0xbf58476d1ce4e5b9u) + part(2, 0x94d049bb133111ebu);
    return static_cast<std::size_t>(h >> 32) & (heads_.size() - 1);
  }
  void relocate(std::uint32_t i, const Vec3& p);
  void link(std::uint32_t i);
  void unlink(std::uint32_t i);
  void grow();

  double
      half_box_;  // half a side of the box that is looked into: the reach and what a point may have moved untold
  double reach2_;   // squared, of a little more than that
  double untold2_;  // squared: how far a point may move untold
  double
      inverse_size_;  // of a cube: four times the reach, so that a box mostly touches one or two along each axis
  std::vector<std::uint32_t> heads_;
  std::vector<Entry> entries_;  // by point
};

}  // namespace hallway
