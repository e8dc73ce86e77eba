// SPDX-License-Identifier: MIT
// The best that a log allows: all poses and landmarks by least squares at once (bundle adjustment, with Ceres), given which landmark each point is. With
// noise that is the same in every direction and at every range this is the maximum of the likelihood.
#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "eval/point_error.hpp"
#include "geometry/rigid_fit.hpp"
#include "log/landmarks.hpp"
#include "log/observations.hpp"
#include "log/poses.hpp"

namespace hallway::peers {
namespace {

namespace fs = std::filesystem;

struct Choice {
  std::string log;
  std::uint32_t steps = 0;
  std::string true_poses;
  std::string true_landmarks;
  std::string out;
  int threads = 1;
};

/// A log with what is known of it.
struct Input {
  log::ObservationLog observations;
  std::map<std::uint32_t, Pose> poses;        ///< T_world_body by iteration
  std::map<log::LandmarkId, Vec3> landmarks;  ///< world
};

/// What is solved for, in the frame of the first pose.
struct Estimate {
  /// Rotation vector and position of each iteration that sees something.
  std::map<std::uint32_t, std::array<double, 6>> poses;
  std::map<log::LandmarkId, Vec3> landmarks;
};

/// A landmark seen from a pose: what lies between the landmark and where the pose puts the point.
struct Sighting {
  Vec3 point;

  template <typename T>
  bool operator()(const T* pose, const T* landmark, T* residual) const {
    const T p[3] = {T(point.x()), T(point.y()), T(point.z())};
    T placed[3];
    ceres::AngleAxisRotatePoint(pose, p, placed);
    for (int i = 0; i < 3; ++i) residual[i] = placed[i] + pose[3 + i] - landmark[i];
    return true;
  }
};

Vec3 to_vec(const std::array<double, 3>& p) {
  return {p[0], p[1], p[2]};
}

/// The first of these files that is there.
std::optional<fs::path> one_of(const fs::path& folder, std::initializer_list<const char*> names) {
  std::error_code code;
  for (const char* name : names) {
    if (fs::exists(folder / name, code)) return folder / name;
  }
  return std::nullopt;
}

Input read_input(const Choice& choice) {
  fs::path file = choice.log;
  std::error_code code;
  if (fs::is_directory(file, code))
    file = one_of(file, {"observations.csv", "obs.csv"}).value_or(file / "obs.csv");
  const fs::path folder = file.parent_path();
  const auto chosen = [&](const std::string& named, std::initializer_list<const char*> names) {
    return named.empty() ? one_of(folder, names) : std::optional<fs::path>(named);
  };
  Input input;
  log::ReadLog read = log::read_observations(file);
  if (read.damage) throw Error(ErrorCode::kBadInput, log::describe(*read.damage, read.log, file.string()));
  if (!read.log.has_identities()) {
    throw Error(ErrorCode::kBadInput, "has no column landmark_id: which point is which must be known",
                {.file = file.string()});
  }
  input.observations = std::move(read.log);
  if (const auto path = chosen(choice.true_poses, {"truth_poses.csv", "gt_poses.csv"})) {
    for (const log::IterationPose& pose : log::read_poses(*path)) {
      const auto& q = pose.orientation;
      input.poses[pose.iteration] = {Quat(q[0], q[1], q[2], q[3]).normalized(), to_vec(pose.position_m)};
    }
  }
  if (const auto path = chosen(choice.true_landmarks, {"truth_landmarks.csv", "gt_landmarks.csv"})) {
    for (const log::Landmark& landmark : log::read_landmarks(*path))
      input.landmarks[landmark.id] = to_vec(landmark.position_m);
  }
  return input;
}

std::uint32_t steps_of(const Input& input, const Choice& choice) {
  const std::uint32_t all = input.observations.iterations();
  return choice.steps == 0 ? all : std::min(all, choice.steps);
}

/// A start: each frame is fitted to the means of what was seen before, which then take it in. Uses no truth but which point is which.
Estimate chain(const Input& input, std::uint32_t steps) {
  Estimate estimate;
  std::map<log::LandmarkId, double> seen;
  for (std::uint32_t i = 0; i < steps; ++i) {
    std::vector<Vec3> from, to;
    for (const log::Observation& point : input.observations.frame(i)) {
      const auto known = estimate.landmarks.find(point.landmark);
      if (known == estimate.landmarks.end()) continue;
      from.push_back(to_vec(point.point));
      to.push_back(known->second);
    }
    if (input.observations.frame(i).empty()) continue;
    if (!estimate.poses.empty() && from.size() < 3) {
      throw Error(
          ErrorCode::kBadInput,
          fmt::format("iteration {} shares {} landmarks with those before; 3 are needed", i, from.size()));
    }
    const Pose pose = estimate.poses.empty() ? Pose() : *rigid_fit(from, to);
    for (const log::Observation& point : input.observations.frame(i)) {
      if (point.landmark == log::kNoLandmark) continue;
      Vec3& mean = estimate.landmarks.try_emplace(point.landmark, Vec3::Zero()).first->second;
      mean += (pose * to_vec(point.point) - mean) / ++seen[point.landmark];
    }
    std::array<double, 6>& block = estimate.poses[i];
    const double q[4] = {pose.q.w(), pose.q.x(), pose.q.y(), pose.q.z()};
    ceres::QuaternionToAngleAxis(q, block.data());
    std::copy_n(pose.t.data(), 3, block.data() + 3);
  }
  if (estimate.poses.empty()) throw Error(ErrorCode::kBadInput, "nothing is seen");
  return estimate;
}

ceres::Solver::Summary solve(const Input& input, int threads, Estimate& estimate) {
  ceres::Problem problem;
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (auto& [iteration, pose] : estimate.poses) {
    for (const log::Observation& point : input.observations.frame(iteration)) {
      if (point.landmark == log::kNoLandmark) continue;
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<Sighting, 3, 6, 3>(new Sighting{to_vec(point.point)}), nullptr,
          pose.data(), estimate.landmarks.at(point.landmark).data());
    }
  }
  // The group with fewer unknowns is what is left when the other is eliminated.
  constexpr std::size_t kMostDense = 4500;
  const std::size_t of_landmarks = 3 * estimate.landmarks.size(), of_poses = 6 * estimate.poses.size();
  const bool poses_first = of_landmarks <= of_poses;
  for (auto& [iteration, pose] : estimate.poses) {
    if (problem.HasParameterBlock(pose.data())) ordering->AddElementToGroup(pose.data(), poses_first ? 0 : 1);
  }
  for (auto& [id, landmark] : estimate.landmarks)
    ordering->AddElementToGroup(landmark.data(), poses_first ? 1 : 0);
  problem.SetParameterBlockConstant(estimate.poses.begin()->second.data());
  ceres::Solver::Options options;
  options.linear_solver_type =
      std::min(of_landmarks, of_poses) <= kMostDense ? ceres::DENSE_SCHUR : ceres::SPARSE_SCHUR;
  options.linear_solver_ordering = ordering;
  options.num_threads = threads;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-12;
  options.gradient_tolerance = 1e-9;
  options.parameter_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) throw Error(ErrorCode::kInternal, "Ceres: " + summary.message);
  return summary;
}

nlohmann::ordered_json number_or_null(std::optional<double> value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

/// Errors against the truth, as far as it is known.
nlohmann::ordered_json score(const Input& input, const Estimate& estimate) {
  std::vector<Vec3> truth, found;
  for (const auto& [id, position] : estimate.landmarks) {
    const auto known = input.landmarks.find(id);
    if (known == input.landmarks.end()) continue;
    truth.push_back(known->second);
    found.push_back(position);
  }
  nlohmann::ordered_json json;
  const auto first = input.poses.find(estimate.poses.begin()->first);
  json["landmark_rmse_m"] = {
      {"aligned", number_or_null(eval::aligned_rmse(truth, found))},
      {"first_pose", first == input.poses.end() ? nlohmann::ordered_json(nullptr)
                                                : number_or_null(eval::rmse(truth, found, first->second))}};
  truth.clear();
  found.clear();
  for (const auto& [iteration, pose] : estimate.poses) {
    const auto known = input.poses.find(iteration);
    if (known == input.poses.end()) continue;
    truth.push_back(known->second.t);
    found.emplace_back(pose[3], pose[4], pose[5]);
  }
  json["position_rmse_m"] = {{"aligned", number_or_null(eval::aligned_rmse(truth, found))}};
  return json;
}

void write(const fs::path& folder, const Estimate& estimate) {
  fs::create_directories(folder);
  std::vector<log::IterationPose> poses;
  for (const auto& [iteration, pose] : estimate.poses) {
    std::array<double, 4> q{};
    ceres::AngleAxisToQuaternion(pose.data(), q.data());
    poses.push_back({.iteration = iteration, .position_m = {pose[3], pose[4], pose[5]}, .orientation = q});
  }
  std::vector<log::Landmark> landmarks;
  for (const auto& [id, p] : estimate.landmarks) landmarks.push_back({id, {p.x(), p.y(), p.z()}});
  log::write_poses(folder / "poses.csv", poses);
  log::write_landmarks(folder / "landmarks.csv", landmarks);
}

int run(const Choice& choice) {
  const Input input = read_input(choice);
  const auto start = std::chrono::steady_clock::now();
  Estimate estimate = chain(input, steps_of(input, choice));
  const ceres::Solver::Summary summary = solve(input, choice.threads, estimate);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  nlohmann::ordered_json json{{"schema", "hallway.batch_ml/1"},
                              {"iterations", estimate.poses.size()},
                              {"landmarks", estimate.landmarks.size()},
                              {"observations", summary.num_residuals / 3},
                              {"residual_m", std::sqrt(2.0 * summary.final_cost / summary.num_residuals)},
                              {"solver_steps", summary.iterations.size()},
                              {"converged", summary.termination_type == ceres::CONVERGENCE},
                              {"seconds", took.count()}};
  json.update(score(input, estimate));
  if (!choice.out.empty()) write(choice.out, estimate);
  std::puts(json.dump(2).c_str());
  return 0;
}

}  // namespace
}  // namespace hallway::peers

int main(int argc, char** argv) {
  hallway::peers::Choice choice;
  CLI::App app(
      "Batch maximum likelihood of a log: all poses and landmarks at once, given which landmark each point "
      "is. Prints JSON.",
      "batch_ml");
  app.add_option("log", choice.log,
                 "CSV file of observations with landmark_id, or a folder with one and the truth beside it")
      ->required();
  app.add_option("--steps", choice.steps, "Number of iterations [all]");
  app.add_option("--truth-poses", choice.true_poses, "CSV [truth_poses.csv or gt_poses.csv beside the log]");
  app.add_option("--truth-landmarks", choice.true_landmarks,
                 "CSV [truth_landmarks.csv or gt_landmarks.csv beside the log]");
  app.add_option("--out", choice.out,
                 "Folder for poses.csv and landmarks.csv, in the frame of the first pose");
  app.add_option("--threads", choice.threads, "Threads of the solver [1]")->check(CLI::Range(1, 64));
  CLI11_PARSE(app, argc, argv);
  try {
    return hallway::peers::run(choice);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "batch_ml: %s\n", error.what());
    return 3;
  }
}
