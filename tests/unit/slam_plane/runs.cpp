// SPDX-License-Identifier: MIT
#include "unit/slam_plane/runs.hpp"

#include <algorithm>
#include <map>
#include <numbers>

namespace hallway::slam_plane::test {
namespace {

constexpr int kLeastSeen = 20;
constexpr double kOverlap_m = 0.2;
constexpr double kFalseCorner_m = 0.1;

}  // namespace

Options options_for(const Sensor& sensor) {
  Options options;
  options.noise_m = std::max(sensor.noise_m, 1e-4);
  options.noise_angle_deg = std::max(sensor.noise_angle_rad * 180.0 / std::numbers::pi, 1e-3);
  options.noise_end_m = std::max(sensor.noise_end_m, 1e-4);
  options.noise_along_m = sensor.noise_along_m;
  return options;
}

Mapping run(const Scene& scene, const Sensor& sensor, const Options& options, std::uint64_t seed,
            bool with_batch) {
  return run(scene, observe(scene, sensor, seed), sensor, options, with_batch);
}

Mapping run(const Scene& scene, const std::vector<TrueFrame>& frames, const Sensor& sensor,
            const Options& options, bool with_batch) {
  Mapper mapper(options);
  Mapping result;
  std::vector<std::vector<LandmarkId>> associations;
  std::map<LandmarkId, std::map<int, int>> votes;
  std::vector<int> seen(scene.walls.size(), 0);
  for (const TrueFrame& frame : frames) {
    const Answer& answer = mapper.process(frame.observations, sensor.view);
    result.counters = answer.counters;
    if (!answer.has_pose) ++result.lost;
    const Pose2 report_map = frames.front().T_world_robot * answer.T_map_robot;
    result.online2 += answer.has_pose ? (report_map.t - frame.T_world_robot.t).squaredNorm() : 0.0;
    associations.push_back(answer.associations);
    for (std::size_t i = 0; i < frame.observations.size(); ++i) {
      if (frame.wall[i] >= 0) ++seen[static_cast<std::size_t>(frame.wall[i])];
      if (answer.associations[i] != kNoLandmark) ++votes[answer.associations[i]][frame.wall[i]];
    }
  }
  result.map = mapper.refined_map();

  std::map<LandmarkId, int> majority;
  for (const auto& [id, counts] : votes) {
    int best = -1, most = 0;
    for (const auto& [wall, count] : counts) {
      if (count > most) {
        most = count;
        best = wall;
      }
    }
    majority[id] = best;
    for (const auto& [wall, count] : counts) result.wrong += wall == best ? 0 : count;
  }

  Solution solution;
  solution.walls.resize(scene.walls.size());
  std::vector<std::vector<WallLandmark>> parts(scene.walls.size());
  std::vector<std::uint32_t> observations(scene.walls.size(), 0);
  for (const WallLandmark& wall : result.map.walls) {
    if (wall.status != LandmarkStatus::mapped) continue;
    const int truth = majority.count(wall.id) != 0 ? majority[wall.id] : -1;
    if (truth < 0) continue;
    const auto w = static_cast<std::size_t>(truth);
    const auto overlaps = [&](const WallLandmark& other) {
      const Vec2 d = (other.b - other.a).normalized();
      const double length = (other.b - other.a).norm();
      return std::min(length, d.dot(wall.b - other.a)) - std::max(0.0, d.dot(wall.a - other.a)) > kOverlap_m;
    };
    if (!parts[w].empty()) {
      const bool twice = std::any_of(parts[w].begin(), parts[w].end(), overlaps);
      ++(twice ? result.duplicated : result.split);
    }
    parts[w].push_back(wall);
    if (wall.observations <= observations[w]) continue;
    observations[w] = wall.observations;
    ScoredWall& scored = solution.walls[w];
    scored.known = true;
    scored.point = 0.5 * (wall.a + wall.b);
    scored.direction = (wall.b - wall.a).normalized();
    for (int k = 0; k < 2; ++k) {
      scored.corner[k] = wall.certain[k];
      scored.end[k] = (k == 0 ? -0.5 : 0.5) * (wall.b - wall.a).norm();
    }
  }
  for (std::size_t w = 0; w < scene.walls.size(); ++w) {
    if (seen[w] >= kLeastSeen && !solution.walls[w].known) ++result.missing;
  }
  const Pose2 T_first = frames.front().T_world_robot.inverse();
  for (const TrueFrame& frame : frames) solution.poses.push_back(T_first * frame.T_world_robot);
  fit_poses(frames, sensor, solution);
  result.score = score(scene, solution);
  const Pose2 T_truth_map = alignment(scene, solution);
  for (std::size_t w = 0; w < scene.walls.size(); ++w) {
    const ScoredWall& wall = solution.walls[w];
    if (!wall.known) continue;
    for (int k = 0; k < 2; ++k) {
      const Vec2 truth = k == 0 ? scene.walls[w].a : scene.walls[w].b;
      const Vec2 found = T_truth_map * (wall.point + wall.end[k] * wall.direction);
      if (wall.corner[k] && (found - truth).norm() > kFalseCorner_m) ++result.false_corners;
    }
  }
  if (with_batch) result.batch = score(scene, solve_batch(scene, frames, sensor));
  return result;
}

}  // namespace hallway::slam_plane::test
