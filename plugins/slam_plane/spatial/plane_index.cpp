// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/plane_index.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::slam_plane::spatial {
namespace {

constexpr double kCell_m = 4.0;
constexpr double kMostCells = 1000;          // of a box that stands in the grid
constexpr double kMostCoordinate_m = 1.0e6;  // of one, so that cells have numbers of 20 bits

}  // namespace

Box box_of(std::span<const Vec3> points, const Pose& T) {
  Box box;
  for (const Vec3& p : points) box.extend(T * p);
  return box;
}

/// False for boxes that are too large, or too far away, for the grid.
bool PlaneIndex::cells_of(const Box& box, Cells& cells) {
  double count = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.min()[axis], high = box.max()[axis];
    if (!(low > -kMostCoordinate_m && high < kMostCoordinate_m)) return false;
    const auto at = static_cast<std::size_t>(axis);
    cells.low[at] = static_cast<std::int32_t>(std::floor(low / kCell_m));
    cells.high[at] = static_cast<std::int32_t>(std::floor(high / kCell_m));
    count *= cells.high[at] - cells.low[at] + 1;
  }
  return count <= kMostCells;
}

std::uint64_t PlaneIndex::key(const Cell& cell) {
  constexpr std::uint64_t kMask = (1u << 21) - 1;
  std::uint64_t key = 0;
  for (const std::int32_t c : cell) key = (key << 21) | (static_cast<std::uint64_t>(c) & kMask);
  return key;
}

template <typename Visit>
void PlaneIndex::visit(const Cells& cells, Visit&& visit) {
  for (std::int32_t x = cells.low[0]; x <= cells.high[0]; ++x) {
    for (std::int32_t y = cells.low[1]; y <= cells.high[1]; ++y) {
      for (std::int32_t z = cells.low[2]; z <= cells.high[2]; ++z) visit(Cell{x, y, z});
    }
  }
}

void PlaneIndex::put(Index landmark, std::span<const Vec3> outline) {
  if (landmark >= entries_.size()) entries_.resize(landmark + 1);
  if (outline.empty()) return remove(landmark);
  const Box box = box_of(outline);
  Cells cells;
  const Place place = cells_of(box, cells) ? Place::grid : Place::beside;
  const bool stays =
      entries_[landmark].place == place && (place == Place::beside || entries_[landmark].cells == cells);
  if (!stays) remove(landmark);
  entries_[landmark] = {place, box, cells};
  if (stays) return;
  if (place == Place::beside) {
    beside_.push_back(landmark);
  } else {
    visit(cells, [&](const Cell& cell) { grid_[key(cell)].push_back(landmark); });
  }
}

void PlaneIndex::remove(Index landmark) {
  if (landmark >= entries_.size()) return;
  Entry& entry = entries_[landmark];
  if (entry.place == Place::beside) std::erase(beside_, landmark);
  if (entry.place == Place::grid) {
    visit(entry.cells, [&](const Cell& cell) {
      const auto at = grid_.find(key(cell));
      std::erase(at->second, landmark);
      if (at->second.empty()) grid_.erase(at);
    });
  }
  entry = Entry{};
}

void PlaneIndex::find(const Box& box, std::vector<Index>& found) const {
  found.clear();
  const auto take = [&](Index landmark) {
    if (entries_[landmark].box.intersects(box)) found.push_back(landmark);
  };
  Cells cells;
  if (!cells_of(box, cells)) {
    for (Index landmark = 0; landmark < entries_.size(); ++landmark) {
      if (entries_[landmark].place != Place::out) take(landmark);
    }
    return;
  }
  for (const Index landmark : beside_) take(landmark);
  visit(cells, [&](const Cell& cell) {
    const auto at = grid_.find(key(cell));
    if (at == grid_.end()) return;
    for (const Index landmark : at->second) {
      // Of the cells that both come into the first one tells of it.
      const Cell& low = entries_[landmark].cells.low;
      bool first = true;
      for (std::size_t axis = 0; axis < 3; ++axis)
        first = first && cell[axis] == std::max(low[axis], cells.low[axis]);
      if (first) take(landmark);
    }
  });
  std::ranges::sort(found);
}

}  // namespace hallway::slam_plane::spatial
