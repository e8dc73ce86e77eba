// SPDX-License-Identifier: MIT
#include "slam_point/core/submaps/landmark_merging.hpp"

#include <algorithm>

namespace hallway::slam_point {
namespace {

/// The landmark that `landmark` is the same as, of those nearer than the separation; kNone for none.
/// @param matcher  has the frame's landmarks marked
Index find_twin(const SubmapGraph& graph, Index landmark, double separation_m, const FrameMatcher& matcher,
                const MotionFilter& motion_filter) {
  Index twin = kNone;
  double nearest2 = separation_m * separation_m;
  graph.visit_landmarks_near(graph.landmarks[landmark].position, [&](Index other) {
    const double d2 = (graph.landmarks[other].position - graph.landmarks[landmark].position).squaredNorm();
    // Seen together, they are two. The order of visits is no reason to choose: ties go to the older one.
    const bool together = matcher.is_marked(other) && matcher.is_marked(landmark);
    if (other == landmark || together || graph.landmarks[other].count == 0) return;
    if (d2 < nearest2 && motion_filter.are_two(landmark, other)) return;
    if (d2 < nearest2 || (d2 == nearest2 && other < twin)) {
      nearest2 = d2;
      twin = other;
    }
  });
  return twin;
}

}  // namespace

std::size_t merge_landmarks(SubmapGraph& graph, Index submap, double separation_m, FrameMatcher& matcher,
                            MotionFilter& motion_filter, std::vector<Observation>& frame) {
  std::size_t merged = 0;
  matcher.mark(graph, frame);
  for (const Member& member : graph.submaps[submap].members) {
    if (member.count == 0) continue;
    const Index twin = find_twin(graph, member.landmark, separation_m, matcher, motion_filter);
    if (twin == kNone) continue;
    const Index into = std::min(member.landmark, twin);
    const Index from = std::max(member.landmark, twin);
    graph.merge(into, from);
    motion_filter.merged(from, into);
    for (Observation& observation : frame) {
      if (observation.landmark == from) observation.landmark = into;
    }
    matcher.mark(graph, frame);
    ++merged;
  }
  return merged;
}

}  // namespace hallway::slam_point
