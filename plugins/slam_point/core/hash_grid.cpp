// SPDX-License-Identifier: MIT
#include "slam_point/core/hash_grid.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::slam_point {
namespace {

constexpr std::size_t kFirstTableSize = 1024;
constexpr double kMaxCell = 1e9;  // far cells share the last one instead of overflowing

}  // namespace

HashGrid::HashGrid(double reach_m) : size_(2.0 * reach_m), inverse_size_(1.0 / size_) {}

void HashGrid::add(const Vec3& p) {
  const auto i = static_cast<std::uint32_t>(cells_.size());
  cells_.push_back(cell_of(p));
  next_.push_back(kEnd);
  if (cells_.size() > heads_.size()) {
    grow();
  } else {
    link(i);
  }
}

void HashGrid::move(std::uint32_t i, const Vec3& p) {
  const Cell cell = cell_of(p);
  if (cell == cells_[i]) return;
  unlink(i);
  cells_[i] = cell;
  link(i);
}

void HashGrid::clear() {
  heads_.clear();
  next_.clear();
  cells_.clear();
}

HashGrid::Cell HashGrid::cell_of(const Vec3& p) const {
  Cell cell;
  for (int axis = 0; axis < 3; ++axis) {
    const double scaled = std::clamp(std::floor(p[axis] * inverse_size_), -kMaxCell, kMaxCell);
    cell[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(scaled);
  }
  return cell;
}

std::size_t HashGrid::bucket_of(const Cell& cell) const {
  std::uint64_t h = static_cast<std::uint32_t>(cell[0]);
  h = (h ^ static_cast<std::uint32_t>(cell[1]) * 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
  h = (h ^ static_cast<std::uint32_t>(cell[2]) * 0x94d049bb133111ebu) * 0xbf58476d1ce4e5b9u;
  return static_cast<std::size_t>(h >> 32) & (heads_.size() - 1);
}

void HashGrid::link(std::uint32_t i) {
  std::uint32_t& head = heads_[bucket_of(cells_[i])];
  next_[i] = head;
  head = i;
}

void HashGrid::unlink(std::uint32_t i) {
  std::uint32_t* at = &heads_[bucket_of(cells_[i])];
  while (*at != i) at = &next_[*at];
  *at = next_[i];
  next_[i] = kGone;
}

void HashGrid::grow() {
  heads_.assign(std::max(kFirstTableSize, 2 * heads_.size()), kEnd);
  for (std::uint32_t i = 0; i < cells_.size(); ++i) {
    if (next_[i] != kGone) link(i);
  }
}

}  // namespace hallway::slam_point
