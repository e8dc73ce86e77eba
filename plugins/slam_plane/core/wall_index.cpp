// SPDX-License-Identifier: MIT
#include "slam_plane/core/wall_index.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::slam_plane {
namespace {

constexpr double kCell_m = 4.0;
constexpr double kSlack_m = 0.25;          // that a segment's ends may move before it is put in anew
constexpr double kMostLength_m = 1e4;      // longer segments are not found
constexpr double kMostCoordinate_m = 1e8;  // nor farther ones
constexpr double kStep_m = 1.0;            // between places of a segment that are looked at

}  // namespace

std::int64_t WallIndex::cell(double x) {
  return static_cast<std::int64_t>(std::floor(x / kCell_m));
}

std::uint64_t WallIndex::key(std::int64_t x, std::int64_t y) {
  return (static_cast<std::uint64_t>(x) << 32) ^ (static_cast<std::uint64_t>(y) & 0xffffffffu);
}

void WallIndex::put(Index wall, const Vec2& a, const Vec2& b) {
  if (wall >= entries_.size()) entries_.resize(wall + 1);
  Entry& entry = entries_[wall];
  const double slack2 = kSlack_m * kSlack_m;
  if (entry.in && (entry.a - a).squaredNorm() < slack2 && (entry.b - b).squaredNorm() < slack2) return;
  remove(wall);
  if (!((b - a).norm() < kMostLength_m) || !(a.cwiseAbs().maxCoeff() < kMostCoordinate_m)) return;
  entry.in = true;
  entry.a = a;
  entry.b = b;
  const double reach = kReach_m + kSlack_m + 0.5 * kStep_m;
  const int steps = 1 + static_cast<int>((b - a).norm() / kStep_m);
  for (int i = 0; i <= steps; ++i) {
    const Vec2 p = a + (b - a) * (static_cast<double>(i) / steps);
    for (std::int64_t x = cell(p.x() - reach); x <= cell(p.x() + reach); ++x) {
      for (std::int64_t y = cell(p.y() - reach); y <= cell(p.y() + reach); ++y)
        entry.cells.push_back(key(x, y));
    }
  }
  make_set(entry.cells);
  for (const std::uint64_t k : entry.cells) cells_[k].push_back(wall);
}

void WallIndex::remove(Index wall) {
  if (wall >= entries_.size() || !entries_[wall].in) return;
  Entry& entry = entries_[wall];
  for (const std::uint64_t k : entry.cells) {
    std::vector<Index>& walls = cells_[k];
    walls.erase(std::ranges::find(walls, wall));
    if (walls.empty()) cells_.erase(k);
  }
  entry.cells.clear();
  entry.in = false;
}

void WallIndex::clear() {
  cells_.clear();
  entries_.clear();
}

}  // namespace hallway::slam_plane
