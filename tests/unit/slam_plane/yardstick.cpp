// SPDX-License-Identifier: MIT
#include "unit/slam_plane/yardstick.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "support/dense.hpp"

namespace hallway::slam_plane::test {
namespace {

using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;
using Mat34 = Eigen::Matrix<double, 3, 4>;

constexpr int kLeastCorner = 5;

/// Normal equations of one observation in its frame's pose (x, y, heading) and its wall (turn, offset, ends).
struct Term {
  Mat3 pose = Mat3::Zero();
  Mat34 cross = Mat34::Zero();
  Mat4 wall = Mat4::Zero();
  Vec3 pose_gradient = Vec3::Zero();
  Vec4 wall_gradient = Vec4::Zero();

  void add(const Vec3& jp, const Vec4& jw, double residual, double weight) {
    pose += weight * jp * jp.transpose();
    cross += weight * jp * jw.transpose();
    wall += weight * jw * jw.transpose();
    pose_gradient -= weight * residual * jp;
    wall_gradient -= weight * residual * jw;
  }
};

double square(double x) {
  return x * x;
}

Term term_of(const WallObservation& observation, const bool (&corner)[2], const Pose2& T,
             const ScoredWall& wall, const Sensor& sensor) {
  const double floor2 = 1e-12;  // noise-free data
  const double normal2 = square(sensor.noise_m) + floor2;
  const double angle2 = square(sensor.noise_angle_rad) + floor2;
  const double end2 = square(sensor.noise_end_m) + floor2;
  const double along2 = square(sensor.noise_along_m);
  const Vec2& d = wall.direction;
  const Vec2 l = left_of(d);
  Term term;
  const Vec2 direction = T.rotate(observation.b - observation.a);
  term.add({0, 0, 1}, {-1, 0, 0, 0}, angle_between(d, direction), 1.0 / angle2);
  const Vec2 arm = T.rotate(0.5 * (observation.a + observation.b));
  const double s = d.dot(arm + T.t - wall.point);
  term.add({l.x(), l.y(), l.dot(left_of(arm))}, {-s, -1, 0, 0}, l.dot(arm + T.t - wall.point), 1.0 / normal2);
  // Ends: their mean and difference are independent.
  double residual[2];
  Vec3 jp[2];
  for (int k = 0; k < 2; ++k) {
    const Vec2 reach = T.rotate(k == kEndA ? observation.a : observation.b);
    residual[k] = d.dot(reach + T.t - wall.point) - wall.end[k];
    jp[k] = {d.x(), d.y(), d.dot(left_of(reach))};
  }
  if (corner[0] && corner[1]) {
    term.add(0.5 * (jp[0] + jp[1]), {0, 0, -0.5, -0.5}, 0.5 * (residual[0] + residual[1]),
             1.0 / (along2 + 0.5 * end2));
    term.add(jp[1] - jp[0], {0, 0, 1, -1}, residual[1] - residual[0], 0.5 / end2);
  } else {
    for (int k = 0; k < 2; ++k) {
      if (corner[k])
        term.add(jp[k], {0, 0, k == 0 ? -1.0 : 0.0, k == 1 ? -1.0 : 0.0}, residual[k], 1.0 / (along2 + end2));
    }
  }
  return term;
}

/// Holds the pose in a direction of the position that is known to worse than 0.1 m. True if there was none.
bool hold_open(Mat3& pose) {
  pose += 1e-9 * Mat3::Identity();
  const Mat2 position =
      pose.topLeftCorner<2, 2>() - pose.topRightCorner<2, 1>() * pose.bottomLeftCorner<1, 2>() / pose(2, 2);
  const dense::Spectrum2 eigen = dense::eigen_of(position);
  bool determined = true;
  for (int i = 0; i < 2; ++i) {
    if (eigen.values(i) >= 100.0) continue;
    const Vec2 u = eigen.vectors.col(i);
    pose.topLeftCorner<2, 2>() += 1e10 * u * u.transpose();
    determined = false;
  }
  return determined;
}

void move_wall(ScoredWall& wall, const Vec4& x) {
  wall.point += x(1) * left_of(wall.direction);
  wall.direction = Pose2::at(Vec2::Zero(), x(0)).rotate(wall.direction).normalized();
  wall.end[0] += x(2);
  wall.end[1] += x(3);
}

Solution from_truth(const Scene& scene, const std::vector<TrueFrame>& frames) {
  Solution solution;
  solution.walls.resize(scene.walls.size());
  solution.determined.resize(frames.size(), true);
  std::vector<int> seen(scene.walls.size(), 0);
  std::vector<int> corners[2];
  corners[0] = corners[1] = seen;
  for (const TrueFrame& frame : frames) {
    solution.poses.push_back(frame.T_world_robot);
    for (std::size_t i = 0; i < frame.observations.size(); ++i) {
      if (frame.wall[i] < 0) continue;
      const auto w = static_cast<std::size_t>(frame.wall[i]);
      ++seen[w];
      for (int k = 0; k < 2; ++k) corners[k][w] += frame.corner[k][i] ? 1 : 0;
    }
  }
  for (std::size_t w = 0; w < scene.walls.size(); ++w) {
    ScoredWall& wall = solution.walls[w];
    const Vec2 way = scene.walls[w].b - scene.walls[w].a;
    wall.known = seen[w] > 0;
    wall.direction = way.normalized();
    wall.point = 0.5 * (scene.walls[w].a + scene.walls[w].b);
    wall.end[0] = -0.5 * way.norm();
    wall.end[1] = 0.5 * way.norm();
    for (int k = 0; k < 2; ++k) wall.corner[k] = corners[k][w] >= kLeastCorner;
  }
  return solution;
}

void step(const std::vector<TrueFrame>& frames, const Sensor& sensor, Solution& solution) {
  const auto n = static_cast<Eigen::Index>(4 * solution.walls.size());
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(n);
  struct Kept {
    Mat3 inverse;
    Vec3 gradient;
    std::vector<std::pair<Eigen::Index, Mat34>> cross;
  };
  std::vector<Kept> kept(frames.size());
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const TrueFrame& frame = frames[f];
    Mat3 pose = Mat3::Zero();
    Kept& k = kept[f];
    k.gradient.setZero();
    for (std::size_t i = 0; i < frame.observations.size(); ++i) {
      if (frame.wall[i] < 0) continue;
      const auto w = static_cast<std::size_t>(frame.wall[i]);
      const ScoredWall& wall = solution.walls[w];
      const bool corner[2] = {frame.corner[0][i] && wall.corner[0], frame.corner[1][i] && wall.corner[1]};
      const Term term = term_of(frame.observations[i], corner, solution.poses[f], wall, sensor);
      const auto at = static_cast<Eigen::Index>(4 * w);
      pose += term.pose;
      k.gradient += term.pose_gradient;
      h.block<4, 4>(at, at) += term.wall;
      g.segment<4>(at) += term.wall_gradient;
      k.cross.emplace_back(at, term.cross);
    }
    solution.determined[f] = hold_open(pose);
    if (f == 0) pose += 1e12 * Mat3::Identity();
    k.inverse = pose.inverse();
    for (const auto& [i, a] : k.cross) {
      g.segment<4>(i) -= a.transpose() * (k.inverse * k.gradient);
      for (const auto& [j, b] : k.cross) h.block<4, 4>(i, j) -= a.transpose() * k.inverse * b;
    }
  }
  h.diagonal().array() += 1e-6;
  const Eigen::VectorXd x = dense::solve_symmetric(h, g);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    Vec3 gradient = kept[f].gradient;
    for (const auto& [i, a] : kept[f].cross) gradient -= a * x.segment<4>(i);
    const Vec3 move = kept[f].inverse * gradient;
    solution.poses[f] = solution.poses[f].moved(move.head<2>(), move(2));
  }
  for (std::size_t w = 0; w < solution.walls.size(); ++w)
    move_wall(solution.walls[w], x.segment<4>(static_cast<Eigen::Index>(4 * w)));
}

}  // namespace

Solution solve_batch(const Scene& scene, const std::vector<TrueFrame>& frames, const Sensor& sensor) {
  Solution solution = from_truth(scene, frames);
  for (int i = 0; i < 4; ++i) step(frames, sensor, solution);
  return solution;
}

void fit_poses(const std::vector<TrueFrame>& frames, const Sensor& sensor, Solution& solution) {
  solution.determined.assign(frames.size(), false);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const TrueFrame& frame = frames[f];
    for (int iteration = 0; iteration < 4; ++iteration) {
      Mat3 pose = Mat3::Zero();
      Vec3 gradient = Vec3::Zero();
      for (std::size_t i = 0; i < frame.observations.size(); ++i) {
        if (frame.wall[i] < 0) continue;
        const ScoredWall& wall = solution.walls[static_cast<std::size_t>(frame.wall[i])];
        if (!wall.known) continue;
        const bool corner[2] = {frame.corner[0][i] && wall.corner[0], frame.corner[1][i] && wall.corner[1]};
        const Term term = term_of(frame.observations[i], corner, solution.poses[f], wall, sensor);
        pose += term.pose;
        gradient += term.pose_gradient;
      }
      solution.determined[f] = hold_open(pose);
      const Vec3 move = pose.ldlt().solve(gradient);
      solution.poses[f] = solution.poses[f].moved(move.head<2>(), move(2));
    }
  }
}

void Score::add(const Score& other) {
  corner2 += other.corner2;
  corners += other.corners;
  worst_corner = std::max(worst_corner, other.worst_corner);
  position2 += other.position2;
  frames += other.frames;
}

double Score::corner_rmse() const {
  return std::sqrt(corner2 / std::max(1, corners));
}

double Score::position_rmse() const {
  return std::sqrt(position2 / std::max(1, frames));
}

namespace {

/// Corners that the solution knows: found, true.
std::vector<std::pair<Vec2, Vec2>> corner_pairs(const Scene& scene, const Solution& solution) {
  std::vector<std::pair<Vec2, Vec2>> pairs;
  for (std::size_t w = 0; w < scene.walls.size(); ++w) {
    const ScoredWall& wall = solution.walls[w];
    for (int k = 0; k < 2; ++k) {
      if (wall.known && wall.corner[k])
        pairs.emplace_back(wall.point + wall.end[k] * wall.direction,
                           k == 0 ? scene.walls[w].a : scene.walls[w].b);
    }
  }
  return pairs;
}

}  // namespace

Pose2 alignment(const Scene& scene, const Solution& solution) {
  const auto pairs = corner_pairs(scene, solution);
  Vec2 found = Vec2::Zero(), truth = Vec2::Zero();
  for (const auto& [p, q] : pairs) {
    found += p / static_cast<double>(pairs.size());
    truth += q / static_cast<double>(pairs.size());
  }
  double c = 0.0, s = 0.0;
  for (const auto& [p, q] : pairs) {
    c += (p - found).dot(q - truth);
    s += cross(p - found, q - truth);
  }
  Pose2 T;
  T.r = Vec2(c, s).normalized();
  T.t = truth - T.rotate(found);
  return T;
}

Score score(const Scene& scene, const Solution& solution) {
  const auto pairs = corner_pairs(scene, solution);
  const Pose2 T = alignment(scene, solution);
  Score result;
  for (const auto& [p, q] : pairs) {
    const double error2 = (T * p - q).squaredNorm();
    result.corner2 += error2;
    result.worst_corner = std::max(result.worst_corner, std::sqrt(error2));
  }
  result.corners = static_cast<int>(pairs.size());
  for (std::size_t f = 0; f < solution.poses.size(); ++f) {
    if (!solution.determined[f]) continue;
    result.position2 += (T * solution.poses[f].t - scene.path[f].t).squaredNorm();
    ++result.frames;
  }
  return result;
}

}  // namespace hallway::slam_plane::test
