// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/submap_fit.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace hallway::slam_plane::spatial {

double overlap_of(const std::vector<Index>& a, const std::vector<Index>& b) {
  std::vector<Index> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  const std::size_t either = a.size() + b.size() - both.size();
  return either == 0 ? 0.0 : static_cast<double>(both.size()) / static_cast<double>(either);
}

bool SubmapFit::locate(const PlaneMap& map, const std::vector<AssociatedObservation>& frame,
                       Pose& T_submap_robot) {
  struct Known {
    const AssociatedObservation* observation;
    Feature plane;
    std::vector<Feature> certain, others;
  };
  std::vector<Known> known;
  for (const AssociatedObservation& observation : frame) {
    const Member* member = observation.landmark == kNone ? nullptr : map.in_active(observation.landmark);
    if (member == nullptr) continue;
    Known& one = known.emplace_back();
    one.observation = &observation;
    one.plane = fit_plane(member->evidence, member->normal);
    const Quat q_submap_map = map.submaps[map.active()].T_map_submap.q.conjugate();
    for (const EdgeRecord& edge : map.landmarks[observation.landmark].edges) {
      for (const EdgeSum& sum : member->edges) {
        if (sum.id != edge.id) continue;
        (map.is_certain(edge) ? one.certain : one.others)
            .push_back(fit_edge(sum.evidence, one.plane.normal(), q_submap_map * edge.line.normal()));
      }
    }
  }
  const Pose predicted = T_submap_robot;
  for (const bool all_edges : {false, true}) {
    T_submap_robot = predicted;
    fit_.clear();
    for (const Known& one : known) {
      std::vector<const Feature*> edges;
      for (const Feature& edge : one.certain) edges.push_back(&edge);
      for (const Feature& edge : one.others) {
        if (all_edges) edges.push_back(&edge);
      }
      fit_.add(*one.observation, one.plane, std::move(edges));
    }
    if (fit_.solve(T_submap_robot).determined()) return true;
  }
  return false;
}

Index SubmapFit::find_old(const PlaneMap& map, const std::vector<Index>& in_view, double least) {
  Index best = kNone;
  for (Index i = 0; i < map.submaps.size(); ++i) {
    if (i == map.active()) continue;
    std::vector<Index> first;
    for (const Index landmark : map.submaps[i].first_seen) first.push_back(map.resolve(landmark));
    std::ranges::sort(first);
    const double overlap = overlap_of(first, in_view);
    if (overlap < least) continue;
    least = overlap;
    best = i;
  }
  return best;
}

std::vector<Index> SubmapFit::nearest(const PlaneMap& map, const std::vector<Index>& in_view,
                                      std::size_t most) {
  std::vector<std::pair<std::size_t, Index>> shared;
  for (Index i = 1; i < map.submaps.size(); ++i) {
    std::size_t count = 0;
    for (const Member& member : map.submaps[i].members)
      count += std::ranges::binary_search(in_view, member.landmark) ? 1u : 0u;
    if (count > 0) shared.emplace_back(count, i);
  }
  std::ranges::sort(shared, [](const auto& a, const auto& b) { return a > b; });  // of many the newest
  if (shared.size() > most) shared.resize(most);
  std::vector<Index> nearest;
  for (const auto& [count, submap] : shared) nearest.push_back(submap);
  std::ranges::sort(nearest);
  return nearest;
}

}  // namespace hallway::slam_plane::spatial
