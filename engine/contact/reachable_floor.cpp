// SPDX-License-Identifier: MIT
#include "contact/reachable_floor.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/random.hpp"

namespace hallway::contact {
namespace {

constexpr int kCellShift = 2;
static_assert((1 << kCellShift) * kFloorSpacing == kFloorCell);

/// The floor from where Robot::put() puts the robot.
FloorGraph explore(const Obstacles& obstacles, const RobotSpec& spec, const Pose& start,
                   const std::function<bool(const Vec3&)>& is_solid) {
  Robot robot(obstacles, spec);
  const Vec3 ahead = start.q * Vec3::UnitX();
  if (robot.put(start.t, std::atan2(ahead.y(), ahead.x()), 0, is_solid) != Start::kStands) return {};
  return explore_floor(obstacles, spec, robot.pose());
}

std::int32_t index_of(double metres, double size) {
  return static_cast<std::int32_t>(std::floor(std::clamp(metres, -2e6, 2e6) / size));
}

}  // namespace

ReachableFloor::ReachableFloor(const Obstacles& obstacles, const RobotSpec& spec, const Pose& start,
                               std::function<bool(const Vec3&)> is_solid)
    : obstacles_(obstacles),
      spec_(spec),
      is_solid_(std::move(is_solid)),
      graph_(explore(obstacles, spec, start, is_solid_)) {
  order_.resize(nodes().size());
  for (std::uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
  std::ranges::sort(order_, {}, [&](std::uint32_t i) {
    const FloorNode& node = nodes()[i];
    return std::tuple(node.ix, node.iy, node.z);
  });
  make_cells();
  make_rooms();
}

void ReachableFloor::make_cells() {
  std::vector<Cell> points;
  for (const FloorNode& node : nodes())
    points.push_back({node.ix >> kCellShift, node.iy >> kCellShift, node.z, node.z});
  std::ranges::sort(points, {}, [](const Cell& cell) { return std::tuple(cell.cx, cell.cy, cell.low); });
  for (const Cell& point : points) {
    const bool is_same = !cells_.empty() && cells_.back().cx == point.cx && cells_.back().cy == point.cy &&
                         point.low - cells_.back().high < kStorey;
    if (is_same)
      cells_.back().high = point.high;
    else
      cells_.push_back(point);
  }
}

std::optional<std::uint32_t> ReachableFloor::cell_at(const Vec3& body_origin) const {
  if (!body_origin.allFinite()) return std::nullopt;
  const std::pair square(index_of(body_origin.x(), kFloorCell), index_of(body_origin.y(), kFloorCell));
  const auto square_of = [](const Cell& cell) { return std::pair(cell.cx, cell.cy); };
  auto cell = std::ranges::lower_bound(cells_, square, {}, square_of);
  for (; cell != cells_.end() && square_of(*cell) == square; ++cell) {
    if (body_origin.z() >= cell->low - 0.5 * kStorey && body_origin.z() < cell->high + 0.5 * kStorey)
      return static_cast<std::uint32_t>(cell - cells_.begin());
  }
  return std::nullopt;
}

std::optional<std::uint32_t> ReachableFloor::node_at(const Vec3& body_origin) const {
  if (!body_origin.allFinite()) return std::nullopt;
  const std::pair square(index_of(body_origin.x(), kFloorSpacing), index_of(body_origin.y(), kFloorSpacing));
  const auto square_of = [&](std::uint32_t i) { return std::pair(nodes()[i].ix, nodes()[i].iy); };
  std::optional<std::uint32_t> best;
  double least = 0.5 * kStorey;
  auto node = std::ranges::lower_bound(order_, square, {}, square_of);
  for (; node != order_.end() && square_of(*node) == square; ++node) {
    const double away = std::abs(nodes()[*node].z - body_origin.z());
    if (away > least) continue;
    least = away;
    best = *node;
  }
  return best;
}

std::optional<std::uint32_t> ReachableFloor::room_at(const Vec3& body_origin) const {
  const auto node = node_at(body_origin);
  if (!node || !is_core_[*node]) return std::nullopt;
  return room_[*node];
}

std::optional<std::uint32_t> ReachableFloor::room_of(std::uint32_t node) const {
  if (room_.at(node) == kNoFloorNode) return std::nullopt;
  return room_[node];
}

std::optional<FreePlace> ReachableFloor::free_place(std::uint64_t seed, std::uint32_t attempt) const {
  if (nodes().empty()) return std::nullopt;
  const Random random(seed, stream_id("contact.free_place"));
  Robot robot(obstacles_, spec_);
  for (std::uint64_t draw = 0; draw < 1000; ++draw) {
    const auto count = static_cast<double>(nodes().size());
    const auto at = static_cast<std::size_t>(random.uniform(attempt, 2 * draw, 0.0, count));
    const FloorNode& node = nodes()[order_[std::min(at, nodes().size() - 1)]];
    const double turn = random.uniform(attempt, 2 * draw + 1);
    auto rank = static_cast<int>(turn * std::popcount(node.headings));
    int heading = 0;
    while (!(node.headings >> heading & 1) || rank-- > 0) ++heading;
    const double yaw = node.headings == 0xff
                           ? (2.0 * turn - 1.0) * std::numbers::pi
                           : std::remainder(heading * std::numbers::pi / 4.0, 2.0 * std::numbers::pi);
    if (robot.put(node.at(), yaw, 0, is_solid_) != Start::kStands) continue;
    // What is put down on an uneven floor may come to stand on another storey.
    if (std::abs(robot.pose().t.z() - node.z) < 0.5 * kStorey) return FreePlace{node.at(), yaw};
  }
  return std::nullopt;
}

std::optional<FreeStart> find_free_start(const Obstacles& obstacles, const RobotSpec& spec, const Box& bounds,
                                         const std::function<bool(const Vec3&)>& is_solid,
                                         std::uint64_t seed) {
  constexpr std::uint32_t kMostDraws = 20'000;
  constexpr int kStances = 16;
  const Random random(seed, stream_id("contact.free_start"));
  Robot robot(obstacles, spec);
  std::vector<ReachableFloor> floors;
  int stances = 0;
  for (std::uint32_t draw = 0; draw < kMostDraws && stances < kStances; ++draw) {
    Vec3 at;
    for (int axis = 0; axis < 3; ++axis)
      at[axis] =
          random.uniform(draw, static_cast<std::uint64_t>(axis), bounds.min()[axis], bounds.max()[axis]);
    if (is_solid && is_solid(at)) continue;
    const double yaw = random.uniform(draw, 3, -std::numbers::pi, std::numbers::pi);
    if (robot.put(at, yaw, 0, is_solid) != Start::kStands) continue;
    ++stances;
    const Vec3 place = robot.pose().t;
    const bool is_known = std::ranges::any_of(
        floors, [&](const ReachableFloor& floor) { return floor.cell_at(place).has_value(); });
    if (!is_known) floors.emplace_back(obstacles, spec, robot.pose(), is_solid);
  }
  const auto largest =
      std::ranges::max_element(floors, {}, [](const ReachableFloor& floor) { return floor.nodes().size(); });
  if (largest == floors.end()) return std::nullopt;
  const auto place = largest->free_place(seed, 0);
  if (!place) return std::nullopt;
  return FreeStart{*place, std::move(*largest)};
}

}  // namespace hallway::contact
