// SPDX-License-Identifier: MIT
#include "slam_point/core/solver/map_refiner.hpp"

#include <algorithm>

#include "slam_point/core/solver/landmark_covariances.hpp"
#include "slam_point/core/solver/map_step.hpp"

namespace hallway::slam_point {
namespace {

constexpr int kMaxSteps = 20;
constexpr double kMostWork = 2e10;      // multiplications of one step over all segments
constexpr double kLeastFreedom = 50.0;  // of the residuals that estimate the noise

/// Whether no segment before belongs to the same submap.
bool first_of_submap(const SegmentStore& store, Index segment) {
  const std::vector<Segment>& segments = store.segments();
  return std::none_of(segments.begin(), segments.begin() + static_cast<std::ptrdiff_t>(segment),
                      [&](const Segment& other) { return other.submap == segments[segment].submap; });
}

/// A graph whose submaps are the segments; what the map no longer holds is left out.
SubmapGraph graph_of_segments(const SubmapGraph& graph, const SegmentStore& store,
                              const std::vector<Pose>& poses) {
  SubmapGraph fine(1.0, IndexKind::grid, graph.directional_inlier_m());
  fine.planar = graph.planar;
  for (const LandmarkRecord& landmark : graph.landmarks) fine.add_landmark(landmark.position, 0);
  for (const Segment& segment : store.segments()) {
    const Index at = fine.add_submap(poses[segment.submap]);
    // One segment of the submap that each part's frame is; and what was given up has nowhere to go.
    const SubmapRecord& submap = graph.submaps[segment.submap];
    fine.submaps[at].held = submap.held && (submap.part == kNone || first_of_submap(store, at));
    for (std::size_t m = 0; m < segment.members.size(); ++m) {
      const SegmentMember& member = segment.members[m];
      const Index landmark = graph.survivor(member.landmark);
      if (graph.landmarks[landmark].memberships.empty() || member.count == 0) continue;
      const Index place = fine.join(at, landmark, member.mean, false);
      fine.submaps[at].members[place].count = member.count;
      fine.submaps[at].members[place].quality = member.weight / static_cast<double>(member.count);
      if (graph.is_directional()) fine.submaps[at].informations[place] = segment.informations[m];
    }
  }
  return fine;
}

/// Where the evidence puts the landmarks, those without any where they lie.
std::vector<Vec3> positions_of(const SubmapGraph& graph) {
  std::vector<Vec3> positions;
  for (Index l = 0; l < graph.landmarks.size(); ++l) {
    const LandmarkRecord& landmark = graph.landmarks[l];
    positions.push_back(landmark.memberships.empty() ? landmark.position : graph.mean_position(l));
  }
  return positions;
}

/// The variance of one coordinate of an observation of weight 1, from what is left when the map is placed; 0 where too little is.
double noise2_of(const SubmapGraph& fine, const SegmentStore& store) {
  double squares = store.scatter_m2();
  double landmarks = 0.0;
  for (Index l = 0; l < fine.landmarks.size(); ++l) {
    if (fine.landmarks[l].memberships.empty()) continue;
    squares += ReducedSystem::cost_of(fine, fine.poses, l);
    landmarks += 1.0;
  }
  const double axes = fine.planar ? 2.0 : 3.0;
  const double unknowns_of_pose = fine.planar ? 3.0 : 6.0;
  const double freedom = axes * (static_cast<double>(store.observations()) - landmarks) -
                         unknowns_of_pose * (static_cast<double>(store.frames()) - 1.0);
  return freedom >= kLeastFreedom ? squares / freedom : 0.0;
}

}  // namespace

RefinedMap refine_map(const SubmapGraph& graph, const SegmentStore& store,
                      const std::vector<bool>& in_gauge) {
  RefinedMap map;
  map.poses = graph.poses;
  optimise(graph, kMaxSteps, map.poses);
  map.covariances.resize(graph.landmarks.size());
  SubmapGraph fine = graph_of_segments(graph, store, map.poses);
  if (fine.submaps.empty() || step_work(fine) > kMostWork) {
    SubmapGraph whole = graph;
    whole.poses = map.poses;
    map.positions = positions_of(whole);
    return map;
  }
  optimise(fine, kMaxSteps, fine.poses);
  map.positions = positions_of(fine);
  for (Index segment = static_cast<Index>(fine.poses.size()); segment-- > 0;)
    map.poses[store.segments()[segment].submap] = fine.poses[segment];
  map.noise2_m2 = noise2_of(fine, store);
  if (!(map.noise2_m2 > 0.0)) return map;
  map.covariances = landmark_covariances(fine, in_gauge);
  for (std::optional<Mat3>& covariance : map.covariances) {
    if (covariance) *covariance *= map.noise2_m2;
  }
  return map;
}

}  // namespace hallway::slam_point
