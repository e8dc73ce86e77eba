// SPDX-License-Identifier: MIT
// The best that a recorded run of a sensor of planes allows: all poses, lines and corners by least squares at once (Ceres), given which wall each piece is
// of and which of its ends are corners. With the sensor's Gaussian noise this is the maximum of the likelihood. Beside its own errors it tells those of the run's
// poses over the same frames.
#include <ceres/ceres.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>

#include "base/file.hpp"
#include "base/text.hpp"
#include "geometry/rigid_fit.hpp"
#include "plane_run.hpp"

namespace hallway::peers {
namespace {

constexpr double kNoNoise = 1e-6;        // standard deviation of noise-free data
constexpr int kLeastCorner = 5;          // sightings of a corner that counts
constexpr double kUndetermined_m = 0.1;  // standard deviation of a position from which on it is not scored
constexpr std::size_t kBeginning = 50;   // frames that tell where a map begins
constexpr double kHold_m = 10.0;         // of a pose in what nothing determines, about where it began

/// A wall as it is solved for: turn [rad] and offset [m] of its line, and the places of its ends along it [m], against the true wall. `known`:
/// corners that were seen often enough.
struct WallEstimate {
  Point2 middle{}, direction{};  // of the true wall
  double half = 0.0;             // of its length
  std::array<double, 4> x{};     // turn, offset, ends
  int sightings[2] = {0, 0};
  bool seen = false;
};

struct Weights {
  double line, angle, end;
};

template <typename T>
T wrapped(const T& angle) {
  return angle - 2.0 * std::numbers::pi * ceres::floor(angle / (2.0 * std::numbers::pi) + 0.5);
}

/// What lies between a piece that a pose puts into the map and its wall: angle, distance of its middle from the line, and of each end that is a
/// corner, each in standard deviations.
struct Residual {
  SeenWall seen;
  Point2 middle, direction;  // of the true wall
  double half;
  Weights weights;

  template <typename T>
  bool operator()(const T* pose, const T* wall, T* residual) const {
    const T c = ceres::cos(pose[2]), s = ceres::sin(pose[2]);
    const auto place = [&](const Point2& p, T(&out)[2]) {
      out[0] = c * p[0] - s * p[1] + pose[0] - middle[0];
      out[1] = s * p[0] + c * p[1] + pose[1] - middle[1];
    };
    const T tc = ceres::cos(wall[0]), ts = ceres::sin(wall[0]);
    const T d[2] = {tc * direction[0] - ts * direction[1], ts * direction[0] + tc * direction[1]};
    const Point2 &a = seen.piece.a, &b = seen.piece.b;
    const double piece = std::atan2(b[1] - a[1], b[0] - a[0]);
    residual[0] = weights.angle * wrapped(pose[2] + piece - wall[0] - std::atan2(direction[1], direction[0]));
    T at[2];
    place({0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}, at);
    residual[1] = weights.line * (d[0] * at[1] - d[1] * at[0] - wall[1]);
    for (int k = 0; k < 2; ++k) {
      place(k == 0 ? a : b, at);
      const T along = d[0] * at[0] + d[1] * at[1] - (k == 0 ? -half : half) - wall[2 + k];
      residual[2 + k] = seen.corner[k] ? T(weights.end * along) : T(0.0);
    }
    return true;
  }
};

/// Keeps a pose from running away where nothing determines it.
struct Hold {
  Pose3 start;
  template <typename T>
  bool operator()(const T* pose, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = (pose[i] - start[static_cast<std::size_t>(i)]) / kHold_m;
    return true;
  }
};

std::vector<WallEstimate> start_of(PlaneRun& run) {
  std::vector<WallEstimate> walls(run.walls.size());
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const Facing& truth = run.walls[w];
    const double dx = truth.b[0] - truth.a[0], dy = truth.b[1] - truth.a[1];
    walls[w].half = 0.5 * std::hypot(dx, dy);
    walls[w].direction = {0.5 * dx / walls[w].half, 0.5 * dy / walls[w].half};
    walls[w].middle = {0.5 * (truth.a[0] + truth.b[0]), 0.5 * (truth.a[1] + truth.b[1])};
  }
  for (const auto& frame : run.frames) {
    for (const SeenWall& seen : frame) {
      walls[seen.wall].seen = true;
      for (int k = 0; k < 2; ++k) walls[seen.wall].sightings[k] += seen.corner[k] ? 1 : 0;
    }
  }
  for (auto& frame : run.frames) {
    for (SeenWall& seen : frame) {
      for (int k = 0; k < 2; ++k)
        seen.corner[k] = seen.corner[k] && walls[seen.wall].sightings[k] >= kLeastCorner;
    }
  }
  return walls;
}

ceres::Solver::Summary solve(const PlaneRun& run, std::vector<Pose3>& poses,
                             std::vector<WallEstimate>& walls) {
  const Weights weights{1.0 / std::max(run.noise_m, kNoNoise), 1.0 / std::max(run.noise_angle_rad, kNoNoise),
                        1.0 / std::max(run.noise_end_m, kNoNoise)};
  ceres::Problem problem;
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    if (run.frames[i].empty()) continue;
    for (const SeenWall& seen : run.frames[i]) {
      WallEstimate& wall = walls[seen.wall];
      problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Residual, 4, 3, 4>(
                                   new Residual{seen, wall.middle, wall.direction, wall.half, weights}),
                               nullptr, poses[i].data(), wall.x.data());
    }
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Hold, 3, 3>(new Hold{poses[i]}), nullptr,
                             poses[i].data());
    ordering->AddElementToGroup(poses[i].data(), 0);
  }
  for (WallEstimate& wall : walls) {
    if (wall.seen) ordering->AddElementToGroup(wall.x.data(), 1);
  }
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    if (run.frames[i].empty()) continue;
    problem.SetParameterBlockConstant(poses[i].data());
    break;
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.linear_solver_ordering = ordering;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary;
}

/// Whether a frame's own lines and corners determine its position.
bool is_determined(const PlaneRun& run, std::size_t i, const Pose3& pose) {
  const auto square = [](double sigma) { return 1.0 / std::max(sigma * sigma, 1e-12); };
  Eigen::Matrix3d h = 1e-9 * Eigen::Matrix3d::Identity();
  const auto add = [&](const Eigen::Vector2d& across, const Point2& p, double weight) {
    const Eigen::Vector2d arm(-(p[1] - pose[1]), p[0] - pose[0]);
    const Eigen::Vector3d row(across.x(), across.y(), across.dot(arm));
    h += weight * row * row.transpose();
  };
  for (const SeenWall& seen : run.frames[i]) {
    const Point2 a = placed(pose, seen.piece.a), b = placed(pose, seen.piece.b);
    const Eigen::Vector2d d = Eigen::Vector2d(b[0] - a[0], b[1] - a[1]).normalized();
    h(2, 2) += square(run.noise_angle_rad);
    add({-d.y(), d.x()}, {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}, square(run.noise_m));
    for (int k = 0; k < 2; ++k) {
      if (seen.corner[k]) add(d, k == 0 ? a : b, square(run.noise_end_m));
    }
  }
  const Eigen::Matrix2d position =
      h.topLeftCorner<2, 2>() - h.topRightCorner<2, 1>() * h.bottomLeftCorner<1, 2>() / h(2, 2);
  const double worst = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(position).eigenvalues()(0);
  return worst * kUndetermined_m * kUndetermined_m >= 1.0;
}

double rmse(const std::vector<Vec3>& truth, const std::vector<Vec3>& found, const Pose& T_truth_found) {
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) sum += (T_truth_found * found[i] - truth[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, truth.size())));
}

/// Of the poses that the run answered in the frames that are scored (`determined`), as its pose_errors.csv has them: frames, and the root mean square
/// error of the position.
nlohmann::ordered_json score_answers(const std::filesystem::path& file, const std::vector<bool>& determined) {
  std::istringstream rows(read_file(file));
  std::string row;
  std::getline(rows, row);  // the header
  std::size_t count = 0;
  double sum = 0.0;
  while (std::getline(rows, row)) {
    const std::vector<std::string_view> cells = split(row, ',');
    const std::size_t i = std::stoul(std::string(cells.at(0)));
    if (i >= determined.size() || !determined[i]) continue;
    const double error = std::stod(std::string(cells.at(1)));
    ++count;
    sum += error * error;
  }
  return {{"positions", count},
          {"position_rmse_m", std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, count)))}};
}

/// Errors after the rigid motion that brings the corners nearest to the true ones. Sets which frames' positions are scored.
nlohmann::ordered_json score(const PlaneRun& run, const std::vector<Pose3>& poses,
                             const std::vector<WallEstimate>& walls, std::vector<bool>& determined) {
  std::vector<Vec3> truth, found;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const WallEstimate& wall = walls[w];
    const double c = std::cos(wall.x[0]), s = std::sin(wall.x[0]);
    const Vec3 d(c * wall.direction[0] - s * wall.direction[1], s * wall.direction[0] + c * wall.direction[1],
                 0.0);
    const Vec3 origin = Vec3(wall.middle[0], wall.middle[1], 0.0) + wall.x[1] * Vec3(-d.y(), d.x(), 0.0);
    for (int k = 0; k < 2; ++k) {
      if (wall.sightings[k] < kLeastCorner) continue;
      const Point2& end = k == 0 ? run.walls[w].a : run.walls[w].b;
      truth.emplace_back(end[0], end[1], 0.0);
      found.push_back(origin +
                      ((k == 0 ? -wall.half : wall.half) + wall.x[static_cast<std::size_t>(2 + k)]) * d);
    }
  }
  const Pose T = rigid_fit(found, truth).value_or(Pose());
  std::vector<Vec3> true_positions, positions;
  determined.assign(poses.size(), false);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (run.frames[i].empty() || !is_determined(run, i, poses[i])) continue;
    determined[i] = true;
    true_positions.emplace_back(run.poses[i][0], run.poses[i][1], 0.0);
    positions.emplace_back(poses[i][0], poses[i][1], 0.0);
  }
  return {{"corners", truth.size()},
          {"corner_rmse_m", rmse(truth, found, T)},
          {"positions", positions.size()},
          {"position_rmse_m", rmse(true_positions, positions, T)}};
}

/// The motion that brings the first poses on average where they truly were: that of a map which begins there.
Pose3 beginning(const PlaneRun& run, const std::vector<Pose3>& poses) {
  const std::size_t n = std::min(kBeginning, poses.size());
  double turn = 0.0;
  for (std::size_t i = 0; i < n; ++i) turn += wrapped(run.poses[i][2] - poses[i][2]) / static_cast<double>(n);
  Pose3 motion{0.0, 0.0, turn};
  Point2 step{};
  for (std::size_t i = 0; i < n; ++i) {
    const Point2 at = placed(motion, {poses[i][0], poses[i][1]});
    for (std::size_t axis = 0; axis < 2; ++axis)
      step[axis] += (run.poses[i][axis] - at[axis]) / static_cast<double>(n);
  }
  return {step[0], step[1], turn};
}

/// The best that was known at the time: of every `every`th frame the error of its position as solved from what was seen until then, in the frame of the
/// run's beginning.
nlohmann::ordered_json score_so_far(const PlaneRun& run, std::size_t every) {
  std::size_t count = 0;
  double sum = 0.0;
  for (std::size_t last = every; last < run.frames.size(); last += every) {
    PlaneRun part = run;
    part.frames.resize(last + 1);
    part.poses.resize(last + 1);
    std::vector<WallEstimate> walls = start_of(part);
    std::vector<Pose3> poses = part.poses;
    if (part.frames[last].empty() || !is_determined(part, last, poses[last])) continue;
    solve(part, poses, walls);
    const Point2 at = placed(beginning(part, poses), {poses[last][0], poses[last][1]});
    ++count;
    sum += std::pow(at[0] - run.poses[last][0], 2) + std::pow(at[1] - run.poses[last][1], 2);
  }
  return {{"positions", count},
          {"position_rmse_m", std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, count)))}};
}

/// `every`: see score_so_far(); 0: it is not asked for.
int run(const char* folder, std::size_t every) {
  PlaneRun run = read_plane_run(folder);
  const PlaneRun as_seen = run;
  std::vector<WallEstimate> walls = start_of(run);
  std::vector<Pose3> poses = run.poses;
  const ceres::Solver::Summary summary = solve(run, poses, walls);
  nlohmann::ordered_json json{{"schema", "hallway.plane_ml/1"},
                              {"iterations", run.frames.size()},
                              {"solver_steps", summary.iterations.size()},
                              {"converged", summary.termination_type == ceres::CONVERGENCE}};
  std::vector<bool> determined;
  json.update(score(run, poses, walls, determined));
  const std::filesystem::path answers = std::filesystem::path(folder) / "pose_errors.csv";
  if (std::filesystem::exists(answers)) json["answered"] = score_answers(answers, determined);
  if (every > 0) json["so_far"] = score_so_far(as_seen, every);
  std::puts(json.dump(2).c_str());
  return summary.IsSolutionUsable() ? 0 : 1;
}

}  // namespace
}  // namespace hallway::peers

/// A run folder with observed_planes.csv, true_walls.csv and truth_poses.csv, and perhaps every how many frames what was known at the time is solved
/// for. Prints JSON.
int main(int argc, char** argv) {
  const long every = argc == 3 ? std::strtol(argv[2], nullptr, 10) : 0;
  if (argc < 2 || argc > 3 || (argc == 3 && every <= 0)) {
    std::fprintf(stderr, "usage: plane_ml FOLDER [EVERY], of a run of a sensor of planes\n");
    return 2;
  }
  try {
    return hallway::peers::run(argv[1], static_cast<std::size_t>(every));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plane_ml: %s\n", error.what());
    return 3;
  }
}
