// SPDX-License-Identifier: MIT
#include "geometry/hash_grid.hpp"

#include <algorithm>

namespace hallway {
namespace {

constexpr std::size_t kFirstTableSize = 1024;
constexpr double kCubeReaches = 4.0;
constexpr double kUntoldReaches = 0.0625;  // that a point may move before it is taken down
constexpr double kVisitedReaches = 1.125;  // so that neither that nor rounding hides a point
constexpr std::size_t kBucketsPerPoint =
    4;  // at least: most of what a box touches is empty, and should be seen to be

}  // namespace

HashGrid::HashGrid(double reach_m)
    : half_box_((1.0 + kUntoldReaches) * reach_m),
      reach2_(kVisitedReaches * kVisitedReaches * reach_m * reach_m),
      untold2_(kUntoldReaches * kUntoldReaches * reach_m * reach_m),
      inverse_size_(1.0 / (kCubeReaches * reach_m)) {}

void HashGrid::add(const Vec3& p) {
  const auto i = static_cast<std::uint32_t>(entries_.size());
  entries_.push_back({p, cell_of(p), kEnd});
  if (kBucketsPerPoint * entries_.size() > heads_.size()) {
    grow();
  } else {
    link(i);
  }
}

void HashGrid::relocate(std::uint32_t i, const Vec3& p) {
  entries_[i].place = p;
  const Cell cell = cell_of(p);
  if (cell == entries_[i].cell) return;
  unlink(i);
  entries_[i].cell = cell;
  link(i);
}

void HashGrid::clear() {
  heads_.clear();
  entries_.clear();
}

void HashGrid::link(std::uint32_t i) {
  std::uint32_t& head = heads_[bucket_of(entries_[i].cell)];
  entries_[i].next = head;
  head = i;
}

void HashGrid::unlink(std::uint32_t i) {
  std::uint32_t* at = &heads_[bucket_of(entries_[i].cell)];
  while (*at != i) at = &entries_[*at].next;
  *at = entries_[i].next;
  entries_[i].next = kGone;
}

void HashGrid::grow() {
  heads_.assign(std::max(kFirstTableSize, 2 * heads_.size()), kEnd);
  for (std::uint32_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].next != kGone) link(i);
  }
}

}  // namespace hallway
