// SPDX-License-Identifier: MIT
#include "slam_point/core/map_report.hpp"

#include <algorithm>
#include <utility>

#include "slam_point/core/solver/map_refiner.hpp"

namespace hallway::slam_point {
namespace {

bool is_mapped(const MapSource& source, const LandmarkRecord& landmark) {
  return landmark.count >= source.min_observations;
}

void add_landmarks(const MapSource& source, const Pose& anchor, Map& map) {
  const SubmapGraph& graph = source.graph;
  for (Index l = 0; l < graph.landmarks.size(); ++l) {
    const LandmarkRecord& record = graph.landmarks[l];
    if (record.merged_into != kNone || record.moving || record.memberships.empty()) continue;
    if (graph.submaps[record.memberships.front().submap].part != source.part) continue;
    Landmark landmark;
    landmark.id = source.first_id + l;
    landmark.observations = record.count;
    if (is_mapped(source, record)) landmark.status = LandmarkStatus::mapped;
    landmark.position = seen_from(anchor, {{}, graph.mean_position(l)}).t;
    map.landmarks.push_back(landmark);
  }
}

void add_moving(const MapSource& source, const std::vector<Pose>& poses, const Pose& anchor, Map& map) {
  for (const MotionTracks::Track& track : source.moving) {
    if (source.graph.submaps[track.submap].part != source.part) continue;
    Landmark landmark;
    landmark.id = source.first_id + track.landmark;
    landmark.position = seen_from(anchor, {{}, poses[track.submap] * track.place}).t;
    landmark.observations = track.sightings;
    landmark.status = LandmarkStatus::dynamic;
    map.landmarks.push_back(landmark);
  }
  std::sort(map.landmarks.begin(), map.landmarks.end(),
            [](const Landmark& a, const Landmark& b) { return a.id < b.id; });
}

void add_submaps(const MapSource& source, const std::vector<Pose>& poses, const Pose& anchor, Map& map) {
  for (Index s = 0; s < source.graph.submaps.size(); ++s) {
    if (source.graph.submaps[s].part != source.part) continue;
    Submap submap;
    submap.id = s;
    submap.T_map_submap = seen_from(anchor, poses[s]);
    for (const Member& member : source.graph.submaps[s].members) {
      if (member.count > 0) submap.members.push_back(source.first_id + member.landmark);
    }
    map.submaps.push_back(std::move(submap));
  }
}

/// @param poses  T_map_submap, by which submaps and landmarks that move are placed
Map report(const MapSource& source, const std::vector<Pose>& poses) {
  Map map;
  const Pose& anchor = poses[source.parts.anchor_of(source.part)];
  add_landmarks(source, anchor, map);
  add_moving(source, poses, anchor, map);
  add_submaps(source, poses, anchor, map);
  return map;
}

}  // namespace

Pose seen_from(const Pose& anchor, const Pose& pose) {
  const bool same = anchor.t.isZero(0.0) && anchor.q.vec().isZero(0.0);
  return same ? pose : anchor.inverse() * pose;
}

Mat6 seen_from(const Pose& anchor, const Mat6& covariance) {
  const Mat3 turn = anchor.q.toRotationMatrix();
  Mat6 seen;
  for (Eigen::Index row = 0; row < 6; row += 3) {
    for (Eigen::Index column = 0; column < 6; column += 3) {
      const Mat3 half = turn.transpose() * covariance.block<3, 3>(row, column);
      seen.block<3, 3>(row, column) = half * turn;
    }
  }
  return seen;
}

Map report_map(const MapSource& source) {
  return report(source, source.graph.poses);
}

Map report_refined_map(const MapSource& source, const SegmentStore& segments) {
  std::vector<bool> mapped;
  for (const LandmarkRecord& record : source.graph.landmarks)
    mapped.push_back(is_mapped(source, record) && record.part == source.part);
  const RefinedMap refined = refine_map(source.graph, segments, mapped);
  const Pose& anchor = refined.poses[source.parts.anchor_of(source.part)];
  const Mat3 turn = anchor.q.toRotationMatrix().transpose();
  Map map = report(source, refined.poses);
  for (Landmark& landmark : map.landmarks) {
    if (landmark.status == LandmarkStatus::dynamic) continue;
    const std::size_t index = landmark.id - source.first_id;
    landmark.position = seen_from(anchor, {{}, refined.positions[index]}).t;
    landmark.covariance = refined.covariances[index];
    if (landmark.covariance) *landmark.covariance = turn * *landmark.covariance * turn.transpose();
  }
  return map;
}

}  // namespace hallway::slam_point
