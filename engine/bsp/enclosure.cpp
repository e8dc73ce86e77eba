// SPDX-License-Identifier: MIT
#include "bsp/enclosure.hpp"

#include <algorithm>
#include <deque>

#include "bsp/way_out.hpp"

namespace hallway::bsp {
namespace {

Label label_of(const CellSpace& space, std::int32_t cell) {
  return space.tree.cells[static_cast<std::size_t>(cell)].label;
}

/// The cell in which an occupant stands; if that is solid, an empty one beside it; else -1.
std::int32_t cell_of(const CellSpace& space, const Vec3& place_m) {
  constexpr double kBeside = 0.01;  // map units
  const Vec3 place = place_m / space.metres_per_unit;
  std::vector<Vec3> tries{place};
  for (int axis = 2; axis >= 0; --axis) {
    for (const double step : {kBeside, -kBeside}) tries.push_back(place + step * Vec3::Unit(axis));
  }
  for (const Vec3& point : tries) {
    const std::uint32_t cell = space.tree.leaves[leaf_at(space.planes, space.tree, point)].cell;
    if (space.tree.cells[cell].label == Label::kEmpty) return static_cast<std::int32_t>(cell);
  }
  return -1;
}

std::vector<bool> flood(const CellSpace& space, const std::vector<bool>& open) {
  std::vector<std::vector<std::int32_t>> next(space.tree.cells.size());
  std::vector<bool> wet(space.tree.cells.size(), false);
  std::deque<std::int32_t> front;
  const auto reach = [&](std::int32_t cell) {
    if (wet[static_cast<std::size_t>(cell)] || label_of(space, cell) != Label::kEmpty) return;
    wet[static_cast<std::size_t>(cell)] = true;
    front.push_back(cell);
  };
  for (std::size_t p = 0; p < space.portals.size(); ++p) {
    if (!open[p]) continue;
    const auto& [a, b] = space.portals[p].region;
    if (a == ExactPortal::kBeyond || b == ExactPortal::kBeyond) {
      reach(std::max(a, b));
    } else {
      next[static_cast<std::size_t>(a)].push_back(b);
      next[static_cast<std::size_t>(b)].push_back(a);
    }
  }
  while (!front.empty()) {
    const std::int32_t cell = front.front();
    front.pop_front();
    for (const std::int32_t other : next[static_cast<std::size_t>(cell)]) reach(other);
  }
  return wet;
}

/// Portals between empty cells, and of empty cells with the void, that are wide enough.
std::vector<bool> find_open(const CellSpace& space, double narrowest_m) {
  std::vector<bool> open(space.portals.size(), false);
  for (std::size_t p = 0; p < space.portals.size(); ++p) {
    const ExactPortal& portal = space.portals[p];
    const bool empty = std::all_of(portal.region.begin(), portal.region.end(), [&](std::int32_t cell) {
      return cell == ExactPortal::kBeyond || label_of(space, cell) == Label::kEmpty;
    });
    open[p] = empty && width(space.planes, portal.facet) * space.metres_per_unit >= narrowest_m;
  }
  return open;
}

}  // namespace

Enclosure find_enclosure(const CellSpace& space, const std::vector<Vec3>& occupants_m, double narrowest_m) {
  Enclosure enclosure;
  const std::vector<bool> open = find_open(space, narrowest_m);
  enclosure.outside = flood(space, open);
  std::vector<std::int32_t> cells;
  for (std::size_t i = 0; i < occupants_m.size(); ++i) {
    cells.push_back(cell_of(space, occupants_m[i]));
    if (cells[i] < 0) {
      enclosure.in_solid.push_back(i);
    } else if (enclosure.outside[static_cast<std::size_t>(cells[i])]) {
      enclosure.leaking.push_back(i);
    }
  }
  enclosure.sealed = enclosure.leaking.empty() && enclosure.in_solid.size() < occupants_m.size();
  if (enclosure.leaking.empty()) return enclosure;
  const WaysOut ways(space, open);
  const auto length_of = [&](std::size_t i) { return ways.length_m(occupants_m[i], cells[i]); };
  const std::size_t nearest =
      *std::min_element(enclosure.leaking.begin(), enclosure.leaking.end(),
                        [&](std::size_t a, std::size_t b) { return length_of(a) < length_of(b); });
  enclosure.leak = ways.find(occupants_m[nearest], cells[nearest]);
  enclosure.leak->occupant = nearest;
  return enclosure;
}

}  // namespace hallway::bsp
