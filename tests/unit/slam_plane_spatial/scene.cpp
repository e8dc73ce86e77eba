// SPDX-License-Identifier: MIT
#include "unit/slam_plane_spatial/scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "geometry/rigid_fit.hpp"
#include "sense/face_sensor.hpp"

namespace hallway::slam_plane::spatial::test {
namespace {

constexpr int kLeastFrames = 20;
constexpr double kFalse_m = 0.1;

/// A convex face, counter-clockwise as seen from its empty side.
void add_landmark(sense::FacePlan& plan, std::vector<Vec3> corners) {
  hallway::Polygon face;
  face.plane.normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  face.plane.offset = face.plane.normal.dot(corners[0]);
  face.vertices = std::move(corners);
  plan.faces.push_back(face);
  plan.obstacles.push_back(std::move(face));
}

/// The six faces of a box; of a room, seen from inside.
/// @param left_out  bits of faces that are not made: -x, +x, -y, +y, -z, +z
void add_box(sense::FacePlan& plan, const hallway::Pose& T, const Vec3& low, const Vec3& high, bool inside,
             unsigned left_out = 0) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {0, 1}) {
      if (left_out >> (2 * axis + side) & 1u) continue;
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      std::vector<Vec3> corners;
      for (const auto& [s, t] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
        Vec3 p;
        p[axis] = side == 1 ? high[axis] : low[axis];
        p[a] = s == 1 ? high[a] : low[a];
        p[b] = t == 1 ? high[b] : low[b];
        corners.push_back(T * p);
      }
      if ((side == 0) != inside) std::reverse(corners.begin(), corners.end());
      add_landmark(plan, std::move(corners));
    }
  }
}

/// A box that touches nothing: what stands on a floor would take away of it.
void add_solid(sense::FacePlan& plan, const Vec3& low, const Vec3& high) {
  add_box(plan, hallway::Pose{}, low, high, false);
}

}  // namespace

Scene empty_room(int frames) {
  Scene scene{.name = "empty_room", .plan = {}, .path = {}};
  add_box(scene.plan, hallway::Pose{}, {0.0, 0.0, 0.0}, {10.0, 8.0, 3.2}, true);
  for (int i = 0; i < frames; ++i) {
    const double s = 0.02 * i;  // radians round the circle
    const Vec3 at(5.0 + 2.6 * std::cos(s), 4.0 + 2.2 * std::sin(s), 1.5 + 0.4 * std::sin(2.0 * s));
    scene.path.push_back(
        {from_yaw_pitch_roll(s + 2.2, 0.25 * std::sin(3.0 * s), 0.35 * std::sin(1.7 * s)), at});
  }
  return scene;
}

Scene furnished_room(int frames) {
  Scene scene = empty_room(frames);
  scene.name = "furnished_room";
  add_solid(scene.plan, {0.4, 0.5, 0.6}, {1.9, 1.5, 1.5});
  add_solid(scene.plan, {7.5, 0.6, 0.5}, {8.5, 1.5, 2.2});
  add_solid(scene.plan, {8.0, 6.0, 0.5}, {9.4, 7.0, 1.0});
  add_solid(scene.plan, {1.0, 6.0, 1.0}, {2.0, 7.4, 2.1});
  const hallway::Pose tilted{from_yaw_pitch_roll(0.4, 0.5, 0.3), Vec3(4.8, 4.0, 1.2)};
  add_box(scene.plan, tilted, {-0.5, -0.6, -0.2}, {0.5, 0.6, 0.2}, false);
  return scene;
}

Scene room_with_panel(int frames, std::uint32_t& panel) {
  Scene scene = furnished_room(frames);
  scene.name = "room_with_panel";
  panel = static_cast<std::uint32_t>(scene.plan.faces.size());
  add_landmark(scene.plan, {{3.5, 5.4, 1.4}, {3.5, 6.6, 1.4}, {3.5, 6.6, 2.4}, {3.5, 5.4, 2.4}});
  return scene;
}

Scene two_rooms() {
  Scene scene{.name = "two_rooms", .plan = {}, .path = {}};
  sense::FacePlan& plan = scene.plan;
  add_box(plan, hallway::Pose{}, {0.0, 0.0, 0.0}, {6.0, 5.0, 2.6}, true, 1u << 1);
  add_box(plan, hallway::Pose{}, {6.3, -1.0, 0.0}, {13.0, 6.0, 3.6}, true, 1u << 0);
  // The door's wall on both sides, in three parts, and the door's inside.
  for (const auto& [y0, y1, z0] :
       {std::array{0.0, 1.8, 0.0}, std::array{3.0, 5.0, 0.0}, std::array{1.8, 3.0, 2.1}})
    add_landmark(plan, {{6.0, y1, z0}, {6.0, y0, z0}, {6.0, y0, 2.6}, {6.0, y1, 2.6}});
  for (const auto& [y0, y1, z0] :
       {std::array{-1.0, 1.8, 0.0}, std::array{3.0, 6.0, 0.0}, std::array{1.8, 3.0, 2.1}})
    add_landmark(plan, {{6.3, y0, z0}, {6.3, y1, z0}, {6.3, y1, 3.6}, {6.3, y0, 3.6}});
  add_box(plan, hallway::Pose{}, {6.0, 1.8, 0.0}, {6.3, 3.0, 2.1}, true, 3u);
  add_solid(plan, {1.0, 3.4, 0.6}, {2.0, 4.4, 1.4});
  add_solid(plan, {9.0, 3.5, 0.6}, {10.0, 5.0, 1.8});
  add_solid(plan, {8.5, -0.5, 0.5}, {9.2, 0.3, 1.0});
  const auto fly = [&](const Vec3& from, const Vec3& to, double yaw0, double yaw1, int frames) {
    for (int i = 0; i < frames; ++i) {
      const double s = static_cast<double>(i) / frames;
      const double ease = s * s * (3.0 - 2.0 * s);
      const double k = 0.05 * static_cast<double>(scene.path.size());
      scene.path.push_back(
          {from_yaw_pitch_roll(yaw0 + ease * (yaw1 - yaw0), 0.15 * std::sin(k), 0.2 * std::sin(0.7 * k)),
           from + ease * (to - from)});
    }
  };
  const Vec3 a(1.5, 1.5, 1.2), b(4.8, 2.4, 1.1), c(8.0, 2.3, 1.4), d(11.0, 2.0, 2.4);
  fly(a, b, 0.3, 0.0, 80);
  fly(b, c, 0.0, 0.0, 90);
  fly(c, d, 0.0, 2.0, 90);
  fly(d, c, 2.0, 3.14159, 80);
  fly(c, b, 3.14159, 3.14159, 90);
  fly(b, a, 3.14159, 3.5, 80);
  return scene;
}

Scene ramp_room(int frames) {
  Scene scene{.name = "ramp_room", .plan = {}, .path = {}};
  sense::FacePlan& plan = scene.plan;
  const std::vector<Vec2> profile{{0.0, 0.0}, {0.5, 0.0}, {8.0, 1.875}, {8.0, 3.8}, {0.0, 3.8}};
  std::vector<Vec3> right, left;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const Vec2 &a = profile[i], &b = profile[(i + 1) % profile.size()];
    add_landmark(plan, {{a.x(), 0.0, a.y()}, {b.x(), 0.0, b.y()}, {b.x(), 6.0, b.y()}, {a.x(), 6.0, a.y()}});
    right.emplace_back(a.x(), 0.0, a.y());
    left.emplace_back(a.x(), 6.0, a.y());
  }
  std::reverse(right.begin(), right.end());
  add_landmark(plan, std::move(left));
  add_landmark(plan, std::move(right));
  for (int i = 0; i < frames; ++i) {
    const double s = 0.02 * i;
    const Vec3 at(4.0 + 1.5 * std::cos(s), 3.0 + 1.2 * std::sin(s), 2.3 + 0.3 * std::sin(2.0 * s));
    scene.path.push_back(
        {from_yaw_pitch_roll(s + 2.2, 0.2 + 0.2 * std::sin(3.0 * s), 0.3 * std::sin(1.7 * s)), at});
  }
  return scene;
}

hallway::Pose pose_of(const Pose& T) {
  return {T.q, T.t};
}

std::vector<TrueFrame> see(const Scene& scene, const NoiseOf& noise, std::uint64_t seed) {
  return see(scene, noise, seed, {0, 0, 0, Vec3::Zero()});
}

std::vector<TrueFrame> see(const Scene& scene, const NoiseOf& noise, std::uint64_t seed,
                           const MovingFace& moving) {
  sense::PlaneSensorSpec spec;
  spec.name = "faces";
  spec.shape = sense::PlaneShape::faces;
  spec.vertical_fov = kView.vertical_fov_rad;
  spec.noise_m = noise.plane_m;
  spec.noise_angle = noise.angle_rad;
  spec.noise_end_m = noise.end_m;
  sense::FacePlan plan = scene.plan;
  const auto move = [&](hallway::Polygon& face) {
    for (hallway::Vec3& p : face.vertices) p += moving.step_m;
    face.plane.offset = face.plane.normal.dot(face.vertices.front());
  };
  std::vector<TrueFrame> frames;
  std::vector<hallway::PlaneObservation> seen;
  for (std::size_t i = 0; i < scene.path.size(); ++i) {
    if (i >= moving.begin && i < moving.begin + moving.frames) {
      move(plan.faces[moving.face]);
      move(plan.obstacles[moving.face]);
    }
    sense::FaceSensor(spec, plan, seed).observe(scene.path[i], static_cast<std::uint32_t>(i), seen);
    TrueFrame& frame = frames.emplace_back();
    frame.T_world_robot = scene.path[i];
    for (const hallway::PlaneObservation& plane : seen) {
      frame.observations.push_back({plane.plane.normal, plane.centroid, plane.hull});
      frame.truth.push_back(plane.true_plane);
    }
  }
  return frames;
}

Outcome compare(const Scene& scene, const std::vector<TrueFrame>& frames, const Map& map,
                const std::vector<Answer>& answers) {
  Outcome outcome;
  std::vector<Vec3> from, to;
  std::map<std::uint32_t, int> seen;
  std::map<LandmarkId, std::map<std::uint32_t, int>> votes;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    std::set<std::uint32_t> here;
    for (std::size_t k = 0; k < frames[i].truth.size(); ++k) {
      here.insert(frames[i].truth[k]);
      if (answers[i].associations[k] != kNoLandmark) ++votes[answers[i].associations[k]][frames[i].truth[k]];
    }
    for (const std::uint32_t face : here) ++seen[face];
    if (!answers[i].has_pose) {
      ++outcome.lost;
      continue;
    }
    const Pose& T = answers[i].T_map_robot;
    for (const Vec3& p : {Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0)}) {
      from.push_back(T * p);
      to.push_back(frames[i].T_world_robot * p);
    }
  }
  if (from.empty()) return outcome;
  outcome.counters = answers.back().counters;
  const hallway::Pose T_world_map = *rigid_fit(from, to);
  double squares = 0.0;
  int poses = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!answers[i].has_pose) continue;
    const hallway::Pose T = T_world_map * pose_of(answers[i].T_map_robot);
    const double error = (T.t - frames[i].T_world_robot.t).norm();
    outcome.worst_position_m = std::max(outcome.worst_position_m, error);
    outcome.worst_turn_rad =
        std::max(outcome.worst_turn_rad, hallway::angle_between(T.q, frames[i].T_world_robot.q));
    squares += error * error;
    ++poses;
  }
  outcome.position_rmse_m = std::sqrt(squares / poses);

  std::map<LandmarkId, std::uint32_t> owner;
  for (const auto& [id, of] : votes) {
    const auto most = std::max_element(of.begin(), of.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    owner[id] = most->first;
    for (const auto& [truth, count] : of) outcome.wrong += truth == most->first ? 0 : count;
  }
  std::set<std::uint32_t> mapped;
  double plane_squares = 0.0, edge_squares = 0.0;
  int planes = 0, edges = 0;
  for (const PlaneLandmark& landmark : map.landmarks) {
    if (landmark.status != LandmarkStatus::mapped || !owner.contains(landmark.id)) continue;
    const std::uint32_t truth = owner[landmark.id];
    if (!mapped.insert(truth).second) ++outcome.duplicated;
    const hallway::Polygon& of = scene.plan.faces[truth];
    const std::size_t n = landmark.outline.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 corner = T_world_map * landmark.outline[i];
      const double across = std::abs(of.plane.distance(corner));
      outcome.worst_plane_m = std::max(outcome.worst_plane_m, across);
      plane_squares += across * across;
      ++planes;
      if (!landmark.certain[i]) continue;
      const Vec3 middle = T_world_map * Vec3(0.5 * (landmark.outline[i] + landmark.outline[(i + 1) % n]));
      double least = 1e9;
      for (std::size_t k = 0; k < of.vertices.size(); ++k) {
        const Vec3 &a = of.vertices[k], &b = of.vertices[(k + 1) % of.vertices.size()];
        least = std::min(least, (b - a).normalized().cross(middle - a).norm());
      }
      ++outcome.certain_edges;
      if (least > kFalse_m) {
        ++outcome.false_edges;
        continue;
      }
      outcome.worst_edge_m = std::max(outcome.worst_edge_m, least);
      edge_squares += least * least;
      ++edges;
    }
  }
  outcome.plane_rmse_m = planes > 0 ? std::sqrt(plane_squares / planes) : 0.0;
  outcome.edge_rmse_m = edges > 0 ? std::sqrt(edge_squares / edges) : 0.0;
  for (const auto& [face, count] : seen) {
    if (count >= kLeastFrames && !mapped.contains(face)) ++outcome.missing;
  }
  return outcome;
}

Outcome run(const Scene& scene, const std::vector<TrueFrame>& frames, const Options& options) {
  Mapper mapper(options);
  std::vector<Answer> answers;
  for (const TrueFrame& frame : frames) answers.push_back(mapper.process(frame.observations, kView));
  return compare(scene, frames, mapper.refined_map(), answers);
}

}  // namespace hallway::slam_plane::spatial::test
