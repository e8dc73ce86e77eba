// SPDX-License-Identifier: MIT
#include "slam_point/core/submaps/submap_overlap.hpp"

namespace hallway::slam_point {
namespace {

double overlap_of(std::size_t shared, std::size_t seen, std::size_t seen_first) {
  return static_cast<double>(shared) / static_cast<double>(seen + seen_first - shared);
}

}  // namespace

double SubmapOverlap::with_active(const SubmapGraph& graph, const Observations& frame) {
  const SubmapRecord& submap = graph.submaps[graph.active()];
  std::size_t seen = 0;
  std::size_t shared = 0;
  for (const Observation& observation : frame) {
    if (observation.landmark == kNone) continue;
    ++seen;
    const Index member = graph.landmarks[observation.landmark].active_member;
    if (member != kNone && submap.members[member].in_first_frame) ++shared;
  }
  return overlap_of(shared, seen, submap.first_frame_size);
}

Index SubmapOverlap::best(const SubmapGraph& graph, const Observations& frame, double least) {
  shared_.resize(graph.submaps.size(), 0);
  sharing_.clear();
  std::size_t seen = 0;
  for (const Observation& observation : frame) {
    if (observation.landmark == kNone) continue;
    ++seen;
    for (const Membership& at : graph.landmarks[observation.landmark].memberships) {
      if (!graph.submaps[at.submap].members[at.member].in_first_frame) continue;
      if (shared_[at.submap]++ == 0) sharing_.push_back(at.submap);
    }
  }
  Index best = kNone;
  double best_overlap = least;
  for (const Index submap : sharing_) {
    const double overlap = overlap_of(shared_[submap], seen, graph.submaps[submap].first_frame_size);
    shared_[submap] = 0;
    if (overlap > best_overlap || (overlap == best_overlap && submap < best)) {
      best = submap;
      best_overlap = overlap;
    }
  }
  return best;
}

}  // namespace hallway::slam_point
