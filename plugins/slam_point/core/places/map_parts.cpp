// SPDX-License-Identifier: MIT
#include "slam_point/core/places/map_parts.hpp"

#include <algorithm>

namespace hallway::slam_point {

Index MapParts::begin(SubmapGraph& graph) {
  const auto part = static_cast<Index>(parts_.size());
  parts_.push_back({kNone, true, 0, part});
  ++alive_;
  graph.set_part(part);
  return part;
}

void MapParts::anchor(SubmapGraph& graph, Index submap) {
  parts_.back().anchor = submap;
  graph.submaps[submap].held = true;
}

void MapParts::drop(SubmapGraph& graph, Index part) {
  for (Index submap = 0; submap < graph.submaps.size(); ++submap) {
    if (graph.submaps[submap].part == part) graph.drop(submap);
  }
  parts_[part].alive = false;
  --alive_;
}

Pose MapParts::join(SubmapGraph& graph, Index a, Index b, const Pose& T_a_b) {
  std::size_t size_a = 0;
  std::size_t size_b = 0;
  for (const SubmapRecord& submap : graph.submaps) {
    if (submap.part == a) ++size_a;
    if (submap.part == b) ++size_b;
  }
  const bool b_moves = size_b < size_a || (size_b == size_a && parts_[b].anchor > parts_[a].anchor);
  const Index into = b_moves ? a : b;
  const Index from = b_moves ? b : a;
  const Pose T_into_from = b_moves ? T_a_b : T_a_b.inverse();
  for (Index submap = 0; submap < graph.submaps.size(); ++submap) {
    if (graph.submaps[submap].part != from) continue;
    graph.submaps[submap].part = into;
    graph.poses[submap] = T_into_from * graph.poses[submap];
    waiting_.push_front({submap, from});
  }
  next_member_ = 0;
  const Index younger = std::max(parts_[a].anchor, parts_[b].anchor);
  parts_[into].anchor = std::min(parts_[a].anchor, parts_[b].anchor);
  graph.submaps[younger].held = false;
  parts_[into].number = std::min(parts_[a].number, parts_[b].number);
  parts_[into].frames += parts_[from].frames;
  parts_[from].alive = false;
  --alive_;
  graph.set_part(into);
  return b_moves ? T_a_b : Pose{};
}

bool MapParts::seen_together(const SubmapGraph& graph, Index a, Index b) {
  const std::vector<Membership>& others = graph.landmarks[b].memberships;
  for (const Membership& at : graph.landmarks[a].memberships) {
    for (const Membership& other : others) {
      if (at.submap == other.submap) return true;
    }
  }
  return false;
}

Index MapParts::find_twin(const SubmapGraph& graph, Index landmark) const {
  const Vec3& place = graph.landmarks[landmark].position;
  Index twin = kNone;
  double nearest2 = twin_bound_ * twin_bound_;
  graph.visit_landmarks_near(place, [&](Index other) {
    const double d2 = (graph.landmarks[other].position - place).squaredNorm();
    if (other == landmark || graph.landmarks[other].count == 0 || d2 > nearest2) return;
    // Ties go to the older one, so that the order of visits is no reason to choose.
    if (d2 == nearest2 && twin != kNone && twin < other) return;
    if (seen_together(graph, landmark, other)) return;
    nearest2 = d2;
    twin = other;
  });
  return twin;
}

Index MapParts::move(SubmapGraph& graph, Index landmark) {
  graph.resum(landmark);
  graph.landmarks[landmark].part = graph.part();
  const Index twin = find_twin(graph, landmark);
  if (twin == kNone) return landmark;
  const Index into = std::min(landmark, twin);
  graph.merge(into, std::max(landmark, twin));
  merges_.push_back({std::max(landmark, twin), into});
  return into;
}

void MapParts::advance(SubmapGraph& graph, std::size_t landmarks) {
  while (landmarks > 0 && !waiting_.empty()) {
    const Waiting& waiting = waiting_.front();
    const std::vector<Member>& members = graph.submaps[waiting.submap].members;
    for (; next_member_ < members.size() && landmarks > 0; ++next_member_) {
      const Index landmark = members[next_member_].landmark;
      if (graph.landmarks[landmark].part != waiting.from) continue;
      if (graph.landmarks[landmark].count == 0) continue;  // found to move
      move(graph, landmark);
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
