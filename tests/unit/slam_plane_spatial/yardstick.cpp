// SPDX-License-Identifier: MIT
#include "unit/slam_plane_spatial/yardstick.hpp"

#include <algorithm>
#include <numeric>

#include "slam_plane/spatial/plane_map.hpp"

namespace hallway::slam_plane::spatial::test {
namespace {

constexpr double kOnEdge_m = 0.05;
constexpr int kSteps = 10;

/// Whether an edge that was seen is one of the face's, by the true pose.
bool is_of(const hallway::Polygon& face, const ObservedEdge& edge, const hallway::Pose& T_world_robot) {
  for (std::size_t i = 0; i < face.vertices.size(); ++i) {
    const Vec3& a = face.vertices[i];
    const Vec3 along = (face.vertices[(i + 1) % face.vertices.size()] - a).normalized();
    double most = 0.0;
    for (const Vec3& end : edge.end) most = std::max(most, along.cross(T_world_robot * end - a).norm());
    if (most < kOnEdge_m) return true;
  }
  return false;
}

}  // namespace

Outcome yardstick(const Scene& scene, const std::vector<TrueFrame>& frames, const Options& options) {
  PlaneMap map(options);
  for (std::size_t i = 0; i < scene.plan.faces.size(); ++i) map.add_landmark();
  const hallway::Pose T_map_world = frames.front().T_world_robot.inverse();
  std::vector<Answer> answers(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const hallway::Pose T = T_map_world * frames[i].T_world_robot;
    map.activate(map.add_submap({T.q, T.t}));
    answers[i].has_pose = true;
    answers[i].associations.assign(frames[i].truth.begin(), frames[i].truth.end());
    for (std::size_t k = 0; k < frames[i].observations.size(); ++k) {
      AssociatedObservation observation = observation_of(frames[i].observations[k], k);
      observation.landmark = frames[i].truth[k];
      for (ObservedEdge& edge : observation.edges) {
        edge.is_true = (edge.end[1] - edge.end[0]).norm() > 0.1 &&
                       is_of(scene.plan.faces[observation.landmark], edge, frames[i].T_world_robot);
      }
      map.observe(Pose{}, observation, i);
    }
  }
  std::vector<Index> free(frames.size() - 1);
  std::iota(free.begin(), free.end(), Index{1});
  solve(map, free, kSteps);
  for (std::size_t i = 0; i < frames.size(); ++i) answers[i].T_map_robot = map.submaps[i].T_map_submap;
  return compare(scene, frames, report_map(map, options.min_observations), answers);
}

}  // namespace hallway::slam_plane::spatial::test
