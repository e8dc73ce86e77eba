// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "slam_plane/spatial/types.hpp"

namespace hallway::slam_plane::spatial {

/// A box along the axes [m].
using Box = Eigen::AlignedBox3d;

/// The box about points, moved by T.
Box box_of(std::span<const Vec3> points, const Pose& T = Pose{});

/// Finds planes by the boxes about them: a hash grid of cubes, in each of which stands every plane whose box comes into it. What is very large stands beside
/// the grid.
class PlaneIndex {
 public:
  /// Puts a plane in, or moves it; one without points is taken out. O(cubes that its box comes into), if these change.
  void put(Index landmark, std::span<const Vec3> outline);
  void remove(Index landmark);

  /// All planes whose boxes touch a box, and no others; ascending. O(cubes that the box comes into, and planes in them).
  void find(const Box& box, std::vector<Index>& found) const;

 private:
  using Cell = std::array<std::int32_t, 3>;
  struct Cells {
    Cell low{}, high{};
    bool operator==(const Cells&) const = default;
  };
  enum class Place { out, grid, beside };
  struct Entry {
    Place place = Place::out;
    Box box;
    Cells cells;
  };

  static bool cells_of(const Box& box, Cells& cells);
  static std::uint64_t key(const Cell& cell);
  template <typename Visit>
  static void visit(const Cells& cells, Visit&& visit);

  std::unordered_map<std::uint64_t, std::vector<Index>> grid_;
  std::vector<Index> beside_;
  std::vector<Entry> entries_;  // by plane
};

}  // namespace hallway::slam_plane::spatial
