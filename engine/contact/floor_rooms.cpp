// SPDX-License-Identifier: MIT
// The rooms of a reachable floor: cores, and what is nearest to them along the floor.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>

#include "contact/local_floor.hpp"
#include "contact/reachable_floor.hpp"

namespace hallway::contact {
namespace {

FloorBands bands_of_walls() {
  FloorBands bands;
  bands.body_low = kRoomWallLow;
  bands.body_high = kRoomWallHigh;
  bands.wall_low = 1.0;
  return bands;
}

bool is_clear(const Obstacles& obstacles, const FloorNode& node) {
  static const FloorBands bands = bands_of_walls();
  const LocalFloor floor(obstacles, bands, {Quat::Identity(), node.at()}, kRoomClearance + 0.01);
  return floor.is_free(Vec2::Zero(), Vec2::Zero(), kRoomClearance);
}

}  // namespace

void ReachableFloor::make_rooms() {
  constexpr double kNodeArea = kFloorSpacing * kFloorSpacing;
  room_.assign(nodes().size(), kNoFloorNode);
  is_core_.assign(nodes().size(), false);
  for (std::uint32_t i = 0; i < nodes().size(); ++i) is_core_[i] = is_clear(obstacles_, nodes()[i]);

  std::vector<bool> is_seen(nodes().size(), false);
  std::vector<bool> is_room_core(nodes().size(), false);
  for (const std::uint32_t first : order_) {
    if (!is_core_[first] || is_seen[first]) continue;
    std::vector<std::uint32_t> part{first};
    is_seen[first] = true;
    for (std::size_t i = 0; i < part.size(); ++i) {
      for (const std::uint32_t next : nodes()[part[i]].next) {
        if (next == kNoFloorNode || !is_core_[next] || is_seen[next]) continue;
        is_seen[next] = true;
        part.push_back(next);
      }
    }
    const double area = static_cast<double>(part.size()) * kNodeArea;
    if (area < kLeastRoom) continue;
    for (const std::uint32_t node : part) {
      room_[node] = n_rooms();
      is_room_core[node] = true;
    }
    rooms_.push_back({.core_area_m2 = area});
  }
  is_core_ = std::move(is_room_core);

  // Dijkstra from all cores at once; the lower number of a room decides where ways are equally long.
  using Step = std::tuple<double, std::uint32_t, std::uint32_t>;  // length, room, node
  std::priority_queue<Step, std::vector<Step>, std::greater<>> ways;
  std::vector<double> length(nodes().size(), INFINITY);
  for (const std::uint32_t node : order_) {
    if (!is_core_[node]) continue;
    length[node] = 0.0;
    ways.emplace(0.0, room_[node], node);
  }
  while (!ways.empty()) {
    const auto [so_far, room, node] = ways.top();
    ways.pop();
    if (std::pair(so_far, room) > std::pair(length[node], room_[node])) continue;
    for (std::size_t k = 0; k < 8; ++k) {
      const std::uint32_t next = nodes()[node].next[k];
      if (next == kNoFloorNode) continue;
      const double step = k % 2 == 0 ? kFloorSpacing : kFloorSpacing * std::numbers::sqrt2;
      if (std::pair(so_far + step, room) >= std::pair(length[next], room_[next])) continue;
      length[next] = so_far + step;
      room_[next] = room;
      ways.emplace(length[next], room, next);
    }
  }
  std::vector<double> count(rooms_.size(), 0.0);
  for (const std::uint32_t node : order_) {
    if (room_[node] == kNoFloorNode) continue;
    rooms_[room_[node]].centre += nodes()[node].at();
    count[room_[node]] += 1.0;
  }
  for (std::size_t i = 0; i < rooms_.size(); ++i) {
    rooms_[i].centre /= count[i];
    rooms_[i].area_m2 = count[i] * kNodeArea;
  }
}

}  // namespace hallway::contact
