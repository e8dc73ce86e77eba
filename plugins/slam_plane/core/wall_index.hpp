// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "slam_plane/core/observation.hpp"

namespace hallway::slam_plane {

/// Finds segments near a place: a hash grid of large cells, in each of which stands every segment that comes near it.
class WallIndex {
 public:
  /// A segment is found from each place nearer to it than this, and from some farther ones [m].
  static constexpr double kReach_m = 1.0;

  /// Puts a segment in, or moves it if it has gone farther than the index can overlook.
  void put(Index wall, const Vec2& a, const Vec2& b);
  void remove(Index wall);
  void clear();

  /// Calls visit(wall) for each segment within kReach_m of p, and some farther ones.
  template <typename Visit>
  void visit_near(const Vec2& p, Visit&& visit) const {
    const auto at = cells_.find(key(cell(p.x()), cell(p.y())));
    if (at == cells_.end()) return;
    for (const Index wall : at->second) visit(wall);
  }

 private:
  struct Entry {
    bool in = false;
    Vec2 a, b;
    std::vector<std::uint64_t> cells;
  };

  static std::int64_t cell(double x);
  static std::uint64_t key(std::int64_t x, std::int64_t y);

  std::unordered_map<std::uint64_t, std::vector<Index>> cells_;
  std::vector<Entry> entries_;  // by wall
};

}  // namespace hallway::slam_plane
