// SPDX-License-Identifier: MIT
#include "slam_point/core/places/map_parts.hpp"

#include <algorithm>

namespace hallway::slam_point {

Index MapParts::begin() {
  const auto part = static_cast<Index>(parts_.size());
  parts_.push_back({kNone, true, 0, part});
  ++alive_;
  graph_.set_part(part);
  return part;
}

void MapParts::anchor(Index submap) {
  parts_.back().anchor = submap;
  graph_.submaps[submap].held = true;
}

void MapParts::drop(Index part) {
  for (Index submap = 0; submap < graph_.submaps.size(); ++submap) {
    if (graph_.submaps[submap].part == part) graph_.drop(submap);
  }
  parts_[part].alive = false;
  --alive_;
}

Pose MapParts::join(Index a, Index b, const Pose& T_a_b) {
  std::size_t size_a = 0;
  std::size_t size_b = 0;
  for (const SubmapRecord& submap : graph_.submaps) {
    if (submap.part == a) ++size_a;
    if (submap.part == b) ++size_b;
  }
  const bool b_moves = size_b < size_a || (size_b == size_a && parts_[b].anchor > parts_[a].anchor);
  const Index into = b_moves ? a : b;
  const Index from = b_moves ? b : a;
  const Pose T_into_from = b_moves ? T_a_b : T_a_b.inverse();
  for (Index submap = 0; submap < graph_.submaps.size(); ++submap) {
    if (graph_.submaps[submap].part != from) continue;
    graph_.submaps[submap].part = into;
    graph_.poses[submap] = T_into_from * graph_.poses[submap];
    waiting_.push_front({submap, from});
  }
  next_member_ = 0;
  const Index younger = std::max(parts_[a].anchor, parts_[b].anchor);
  parts_[into].anchor = std::min(parts_[a].anchor, parts_[b].anchor);
  graph_.submaps[younger].held = false;
  parts_[into].number = std::min(parts_[a].number, parts_[b].number);
  parts_[into].frames += parts_[from].frames;
  parts_[from].alive = false;
  --alive_;
  graph_.set_part(into);
  return b_moves ? T_a_b : Pose{};
}

bool MapParts::seen_together(Index a, Index b) const {
  const std::vector<Membership>& others = graph_.landmarks[b].memberships;
  for (const Membership& at : graph_.landmarks[a].memberships) {
    for (const Membership& other : others) {
      if (at.submap == other.submap) return true;
    }
  }
  return false;
}

Index MapParts::move(Index landmark) {
  graph_.resum(landmark);
  graph_.landmarks[landmark].part = graph_.part();
  const Index duplicate = graph_.find_duplicate(landmark, duplicate_bound_,
                                                [&](Index other) { return seen_together(landmark, other); });
  if (duplicate == kNone) return landmark;
  const Merge merge{std::max(landmark, duplicate), std::min(landmark, duplicate)};
  graph_.merge(merge.into, merge.from);
  merges_.push_back(merge);
  return merge.into;
}

void MapParts::advance(std::size_t landmarks) {
  while (landmarks > 0 && !waiting_.empty()) {
    const Waiting& waiting = waiting_.front();
    const std::vector<Member>& members = graph_.submaps[waiting.submap].members;
    for (; next_member_ < members.size() && landmarks > 0; ++next_member_) {
      const Index landmark = members[next_member_].landmark;
      if (graph_.landmarks[landmark].part != waiting.from) continue;
      if (graph_.landmarks[landmark].count == 0) continue;  // found to move
      move(landmark);
      --landmarks;
    }
    if (next_member_ < members.size()) break;
    waiting_.pop_front();
    next_member_ = 0;
  }
}

Index MapParts::first() const {
  for (Index part = 0; part < parts_.size(); ++part) {
    if (parts_[part].alive && parts_[part].anchor == 0) return part;
  }
  return kNone;
}

void MapParts::clear() {
  parts_.clear();
  waiting_.clear();
  alive_ = 0;
  merges_.clear();
  next_member_ = 0;
}

bool PartMeeting::confirm(Index here, Index there, const Pose& T_there_here,
                          const std::vector<Vec3>& points) {
  const bool same =
      here == here_ && there == there_ && std::all_of(points.begin(), points.end(), [&](const Vec3& p) {
        return (T_there_here * p - T_there_here_ * p).norm() <= tolerance_;
      });
  here_ = here;
  there_ = there;
  T_there_here_ = T_there_here;
  return same;
}

}  // namespace hallway::slam_point
